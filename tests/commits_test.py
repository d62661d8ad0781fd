"""Fails where one of the last twenty commits has a message that CONTRIBUTING.md does not allow.

usage: commits_test.py ROOT

A subject is `area: verb ...`, at most 72 characters; a body gives the reason. Commits from before this test are left alone. Exit
code 77 (skipped) outside a checkout of git.
"""

import re
import subprocess
import sys

SUBJECT = re.compile(r"[a-z][\w/+., -]*: [a-z]")
LONGEST = 72
LAST = 20


def faults(message):
    """What is wrong with a commit message; empty if nothing is."""
    subject, _, rest = message.partition("\n")
    found = []
    if not SUBJECT.match(subject):
        found.append("the subject is not `area: verb ...`")
    if len(subject) > LONGEST:
        found.append(f"the subject has {len(subject)} characters, at most {LONGEST} are allowed")
    if not rest.strip():
        found.append("a body that gives the reason is missing")
    return found


def try_rules():
    assert faults("step: shorten long moves\n\nThey were computed again.\n") == []
    for message in ("Shorten long moves\n\nbecause", "step: shorten long moves", "step: " + "x" * 67 + "\n\nbecause"):
        assert len(faults(message)) == 1, message


def git(root, *words):
    done = subprocess.run(["git", "-C", root, *words], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    return done.stdout if done.returncode == 0 else ""


def main(root):
    try_rules()
    if not git(root, "rev-parse", "HEAD"):
        print("no checkout of git")
        return 77
    began = git(root, "log", "--diff-filter=A", "--format=%H", "--", "tests/commits_test.py").split()
    log = git(root, "log", "--no-merges", f"-{LAST}", "--format=%h%x00%B%x01", *([f"{began[-1]}..HEAD"] if began else ["HEAD", "-0"]))
    count, bad = 0, 0
    for entry in filter(str.strip, log.split("\x01")):
        commit, _, message = entry.strip().partition("\x00")
        count += 1
        for fault in faults(message):
            bad += 1
            print(f"{commit} {message.splitlines()[0]!r}: {fault}")
    print(f"{count} messages read, {bad} faults")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
