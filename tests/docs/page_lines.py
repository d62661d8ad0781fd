"""Compares the lines that a page shows with those that a command printed."""
import re

NUMBER = re.compile(r"(?<![\w.])[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
# What depends on the machine within a line.
TIMED = [re.compile(p) for p in (r"\bin [\d.]+ (?:s|min|h)\b", r"^ *cpu .*", r"about [\d.]+ \w+ left", r"[\d.]+x real time")]
TOLERANCE = 0.05


def skeleton(line):
    return " ".join(NUMBER.sub("#", line).split())


def numbers(line):
    for pattern in TIMED:
        line = pattern.sub("", line)
    return [float(n) for n in NUMBER.findall(line)]


def is_near(a, b):
    """Whether two lines of one skeleton have the same numbers; small ones by the last digit that is printed."""
    x, y = numbers(a), numbers(b)
    return len(x) == len(y) and all(abs(p - q) <= TOLERANCE * max(abs(p), abs(q)) for p, q in zip(x, y))


def likeness(line, printed):
    """0 without the same skeleton. Else at least 1; the first columns of a table say which row is meant, near numbers decide after them."""
    if skeleton(line) != skeleton(printed):
        return 0
    words, others = line.split(), printed.split()
    same = next((k for k, (a, b) in enumerate(zip(words, others)) if a != b), len(words))
    return 1 + 0.01 * same / max(1, len(words)) + (0.0001 if is_near(line, printed) else 0)


def align(shown, printed):
    """(shown line, printed line or None) for every line of the page; a last entry (None, line) for one that it lacks.

    Of all assignments that keep the order, and leave out printed lines only at "...", the one of largest likeness; of equal
    ones that of the earliest lines.
    """
    n, m = len(shown), len(printed)
    best = [[0.0] * (m + 1) for _ in range(n + 1)]  # of shown[i:] with printed[j:]
    take = [[None] * (m + 1) for _ in range(n + 1)]
    for i in reversed(range(n)):
        for j in reversed(range(m + 1)):
            if shown[i] == "...":
                skip = best[i][j + 1] if j < m else -1.0
                best[i][j], take[i][j] = (best[i + 1][j], "end") if best[i + 1][j] >= skip else (skip, "skip")
                continue
            like = likeness(shown[i], printed[j]) if j < m else 0
            pair = like + best[i + 1][j + 1] if like else -1.0
            best[i][j], take[i][j] = (pair, "pair") if pair >= best[i + 1][j] else (best[i + 1][j], "miss")
    i = j = 0
    while i < n:
        step = take[i][j]
        if step == "skip":
            j += 1
            continue
        yield shown[i], shown[i] if step == "end" else printed[j] if step == "pair" else None
        i, j = i + 1, j + (step == "pair")
    if j < m and (n == 0 or shown[-1] != "..."):
        yield None, printed[j]


def check_align():
    """A page that is wrong must be found wrong."""
    printed = ["first 10 um", "completed 4 h in 2.5 s", "last 3"]
    rows = ["1 h 5 um", "10.0 h 6 um", "10.2 h 5 um", "end"]
    for shown, lines, good in (
            (printed, printed, True), (["first 10.2 um", "completed 4 h in 9 s", "last 3"], printed, True),
            (["first 11 um", "..."], printed, False), (["first 10 um"], printed, False), (["first 10 um", "..."], printed, True),
            (["...", "last 3"], printed, True), (["second 10 um", "..."], printed, False), (["...", "first 10 um"], printed, False),
            (["first 10 um", "last 3"], printed, False), (["...", "completed 5 h in 2.5 s", "..."], printed, False),
            (["1 h 5 um", "...", "10.2 h 5 um", "end"], rows, True),  # not the row between them
            (["...", "10.0 h 5 um", "..."], rows, False),  # the row after it has near numbers
            (["...", "10.0 h 6 um", "..."], rows, True), (["...", "10.2 h 5 um", "1 h 5 um", "..."], rows, False)):
        pairs = list(align(shown, lines))
        assert all(a is not None and b is not None and is_near(a, b) for a, b in pairs) == good, (shown, pairs)
