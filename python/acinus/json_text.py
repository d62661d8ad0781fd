"""JSON that others may have written, cut short or damaged."""
import json

from acinus.errors import Damaged


def parse_json(text, where, advice, kind=dict):
    """The object that a text holds; with kind=list, a list.

    Raises Damaged, also for texts that are nested without end.
    """
    try:
        value = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise Damaged(f"{where}: is not JSON ({error}). {advice}") from error
    if not isinstance(value, kind):
        raise Damaged(f"{where}: is a {type(value).__name__}, where a {kind.__name__} is expected. {advice}")
    return value


def read_json(path, advice, kind=dict):
    """The same of a file.   Raises FileNotFoundError, Damaged."""
    try:
        with open(path, encoding="utf-8") as file:
            text = file.read()
    except UnicodeDecodeError as error:
        raise Damaged(f"{path}: is not JSON ({error}). {advice}") from error
    return parse_json(text, path, advice, kind)
