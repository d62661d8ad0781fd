"""Who is whose daughter."""
from acinus.errors import NoSuchItem


class Lineage:
    """The family tree of a run, from its events and its table of cells."""

    def __init__(self, parent, born, died):
        self._parent, self._born, self._died = parent, born, died
        self._daughters = {}
        for cell, mother in sorted(parent.items()):
            self._daughters.setdefault(mother, []).append(cell)

    def __len__(self):
        return len(self._parent)

    def __iter__(self):
        return iter(sorted(self._parent))

    def __contains__(self, cell):
        return cell in self._parent

    def _check(self, cell):
        if cell not in self._parent:
            raise NoSuchItem(f"no cell {cell} in this run; ids go up to {max(self._parent, default=-1)}")

    @property
    def founders(self):
        """Cells that were there from the start."""
        return list(self._daughters.get(-1, []))

    def parent(self, cell):
        """Its mother; -1: it was there from the start."""
        self._check(cell)
        return self._parent[cell]

    def daughters(self, cell):
        """Both daughters, or none."""
        self._check(cell)
        return list(self._daughters.get(cell, []))

    def born(self, cell):
        """Time of its birth, s; 0 for founders."""
        self._check(cell)
        return self._born.get(cell, 0.0)

    def ended(self, cell):
        """Time of its division or death, s; None: it is still there."""
        self._check(cell)
        daughters = self._daughters.get(cell)
        return self._born[daughters[0]] if daughters else self._died.get(cell)

    def ancestors(self, cell):
        """Mother, grandmother and so on up to the founder."""
        self._check(cell)
        line = []
        while self._parent[cell] >= 0:
            cell = self._parent[cell]
            line.append(cell)
        return line

    def generation(self, cell):
        """0 for founders."""
        return len(self.ancestors(cell))

    def offspring(self, cell):
        """All descendants, daughters first."""
        found = self.daughters(cell)
        for daughter in found:
            found.extend(self._daughters.get(daughter, []))
        return found

    def newick(self, founder, end):
        """The tree below a founder in Newick format; branch lengths are lives in s, up to `end` for cells that are there."""
        def branch(cell):
            ended = self.ended(cell)
            life = (end if ended is None else ended) - self.born(cell)
            below = ",".join(branch(d) for d in self._daughters.get(cell, []))
            return (f"({below})" if below else "") + f"{cell}:{life:g}"

        self._check(founder)
        return branch(founder) + ";"


def make_lineage(events, ids, parents):
    """events: rows of (time, code, cells);  ids, parents: of the table of cells."""
    parent = {int(i): int(p) for i, p in zip(ids, parents)}
    born, died = {}, {}
    for time, code, cells in events:
        if code == "division" and len(cells) == 3:
            parent.setdefault(cells[0], -1)
            for daughter in cells[1:]:
                parent[daughter], born[daughter] = cells[0], time
        if code == "death":
            died.update((cell, time) for cell in cells)
    return Lineage(parent, born, died)
