"""The blocks of a page, and the comments that say what they are."""
import re
import subprocess

COMMENT = re.compile(r"<!-- (file|fails with|not run|picture|write|prepare|exits|shortened|background|python)(?:: ?| |(?= -->))(.*?) ?-->$")
COMMAND = re.compile(r"(\./acinus\.sh|acinus|mpirun|python3|pvpython|pip|curl|sbatch|[A-Z]+=\S+|nohup) ?")
VARIABLE = re.compile(r"[A-Z_]+=(\$\(.*\)|\S+)$")
SPAN = re.compile(r"(?<!`)`((?:\./acinus\.sh|acinus) [^`]+)`(?!`)")
# A form with words to replace, or a command that is only named.
FORM = re.compile(r"(\S+ [a-z]+$)|.*(\b[A-Z]{2,}\b|\.\.\.)")
ALONE = ("acinus list", "acinus explain", "./acinus.sh help")  # complete without an argument


def comments_above(lines, k):
    """(kind, argument) of the comments in the lines above line k, a blank line between them or not; the first one first."""
    found = []
    while k > 0 and (not lines[k - 1].strip() or COMMENT.match(lines[k - 1].strip())):
        if lines[k - 1].strip():
            found.insert(0, COMMENT.match(lines[k - 1].strip()).groups())
        k -= 1
    return found


def blocks_of(lines):
    """(first line, line after the last, comments) of the blocks and pictures of a page; pictures and spans have one line."""
    k = 0
    while k < len(lines):
        above = comments_above(lines, k) if lines[k].strip() else []
        if lines[k].startswith("    ") and (k == 0 or not lines[k - 1].strip() or above):
            end = k
            while end < len(lines) and (lines[end].startswith("    ") or not lines[end].strip()):
                end += 1
            while not lines[end - 1].strip():
                end -= 1
            yield k, end, above
            k = end
        else:
            if above and above[-1][0] == "picture":
                yield k, k + 1, above
            elif any(is_complete(span) for span in SPAN.findall(lines[k])):
                start = k
                while start > 0 and lines[start - 1].strip() and not COMMENT.match(lines[start - 1].strip()):
                    start -= 1  # what is said above a paragraph or table holds for all its lines
                above = [c for c in comments_above(lines, start) if c[0] == "not run"] if start < k else above
                yield k, k + 1, above + [("spans", "")]
            k += 1


def is_complete(span):
    """Whether a command in a sentence can be run as it stands."""
    return span in ALONE or not FORM.match(span)


def commands_of(block):
    """(line, command) of a block of commands without output. A command ends where its quotes are closed; variables go with the next one."""
    start, text = 0, ""
    for k, line in enumerate(block):
        start, text = (start, text + "\n" + line[4:]) if text else (k, line[4:])
        if text.strip() and subprocess.run(["bash", "-n", "-c", text], stderr=subprocess.DEVNULL).returncode == 0 and not text.endswith("\\") and not VARIABLE.match(text):
            yield start, text
            text = ""
    if text.strip():
        yield start, text


def check_blocks():
    lines = ["text", "", "<!-- file: a.json -->", "", "    {", "", "    }", "", "<!-- picture: a.png -->", "![a](b.png)", "", "    $ b",
             "", "<!-- prepare: acinus run a -->", "<!-- fails with 3 -->", "", "    acinus c '", "    d'", "", "<!-- not run: a cluster -->",
             "    sbatch a", "", "As `acinus list` and `acinus run NAME` and `acinus run`."]
    assert list(blocks_of(lines)) == [
        (4, 7, [("file", "a.json")]), (9, 10, [("picture", "a.png")]), (11, 12, []),
        (16, 18, [("prepare", "acinus run a"), ("fails with", "3")]), (20, 21, [("not run", "a cluster")]), (22, 23, [("spans", "")])
    ], list(blocks_of(lines))
    assert list(commands_of(lines[16:18] + ["    e"])) == [(0, "acinus c '\nd'"), (2, "e")]
    assert list(commands_of(["    A=$(b)", "    c $A"])) == [(0, "A=$(b)\nc $A")]
