"""One equation and its verdict, as data: everything that the paper's reader, the exporter and the report need."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field, fields
from functools import cached_property
from html import escape
from typing import TYPE_CHECKING, Any

from xsec_sym.record.files import plain

if TYPE_CHECKING:
    from sympy import Expr

    from xsec_sym.proof.claim import Claim
    from xsec_sym.proof.domain import Domain
    from xsec_sym.proof.verdict import Verdict

SIDES = ("left", "printed", "corrected")
SIGNS = {"=": "=", "≈": r"\approx", "≥": r"\geq"}
# What `xsec verify --json` tells of an entry; the record keeps the encoded expressions and the steps as well.
PUBLIC = ("id", "source", "section", "label", "title", "kind", "verdict", "left", "printed", "corrected", "edit",
          "domain", "reading", "digits", "witness", "evidence", "mutants", "seconds", "parts", "note")  # fmt: skip


@dataclass(frozen=True)
class Entry:
    """A claim of a source, and what became of it.

    ``left``, ``printed`` and ``corrected`` are LaTeX, set from the tested objects; ``encoded`` holds the same three
    as data, and ``variables`` the domain, so that `form` and `where` need no derivation. ``key`` tells whether
    anything that the verdict rests on has changed since.

    >>> from sympy import Symbol
    >>> from xsec_sym.proof import Source, interval
    >>> from xsec_sym.proof.verdict import Verdict
    >>> u = Symbol("u", real=True)
    >>> claim = Source("an-entry").claim("2", "a cube", left=u**2 * u, printed=u**3, where=[interval(u, 0, 1)])
    >>> entry = Entry.of(claim, Verdict("proved", mutants=8))
    >>> entry.printed, entry.form, entry.where.text()
    ('u^{3}', u**3, 'u in [0, 1]')
    """

    id: str
    source: str
    label: str
    title: str
    verdict: str
    section: str = ""
    kind: str = "equation"
    left: str = ""
    printed: str | None = None
    corrected: str | None = None
    edit: str = ""
    domain: str = ""
    reading: str = ""
    digits: int | None = None
    witness: dict[str, Any] | None = None
    evidence: dict[str, Any] = field(default_factory=dict)
    mutants: int = 0
    seconds: float = 0.0
    note: str = ""
    parts: tuple[str, ...] = ()
    steps: tuple[tuple[int, str], ...] = ()
    encoded: dict[str, Any] = field(default_factory=dict)
    variables: dict[str, Any] = field(default_factory=dict)
    key: str = ""

    @classmethod
    def of(cls, claim: Claim, verdict: Verdict, *, key: str = "", like: Entry | None = None) -> Entry:
        """The entry for a claim with its verdict; ``like`` is an entry of the unchanged claim, to save setting it."""
        told = cls._told(claim) if like is None else {name: getattr(like, name) for name in _TOLD}
        return cls(
            **told,
            verdict=verdict.verdict,
            digits=verdict.digits,
            witness=plain(verdict.witness),
            evidence=plain(verdict.evidence),
            mutants=verdict.mutants,
            seconds=round(verdict.seconds, 2),
            steps=tuple((int(depth), str(said)) for depth, said in verdict.steps) or (like.steps if like else ()),
            note=verdict.note,
            key=key,
        )

    @staticmethod
    def _told(claim: Claim) -> dict[str, Any]:
        from xsec_sym.proof.typeset import latex

        sides = {name: getattr(claim, name) for name in SIDES}
        if claim.kind == "out-of-scope":
            sides["left"] = None
        set_ = {name: None if e is None else latex(e) for name, e in sides.items()}
        return {
            **{n: getattr(claim, n) for n in ("id", "source", "section", "label", "title", "kind", "edit", "reading")},
            **set_,
            "left": set_["left"] or "",
            "domain": claim.domain.text(),
            "parts": tuple(claim.parts),
            "encoded": {name: code for name, e in sides.items() if e is not None and (code := encoded(e)) is not None},
            "variables": _domain_code(claim.domain),
        }

    # --- data --------------------------------------------------------------------------------------

    def to_json(self) -> dict[str, Any]:
        return plain(asdict(self))

    def public(self) -> dict[str, Any]:
        """What other programs are told."""
        data = self.to_json()
        return {name: data[name] for name in PUBLIC}

    @classmethod
    def from_json(cls, data: dict[str, Any]) -> Entry:
        known = {f.name for f in fields(cls)}
        filled = {k: v for k, v in data.items() if k in known}
        filled["parts"] = tuple(filled.get("parts", ()))
        filled["steps"] = tuple((depth, said) for depth, said in filled.get("steps", ()))
        return cls(**filled)

    # --- expressions -------------------------------------------------------------------------------

    def side(self, name: str) -> Expr | None:
        """The SymPy expression of "left", "printed" or "corrected"; None where there is none."""
        if name not in SIDES:
            raise ValueError(f"{name!r} is no side of an equation; the sides are {', '.join(SIDES)}")
        return _decoded(self.encoded[name]) if name in self.encoded else None

    @cached_property
    def form(self) -> Expr:
        """The side that holds: what is printed, unless a corrected form holds instead."""
        name = "printed" if self.corrected is None else "corrected"
        found = self.side(name)
        if found is None:
            raise ValueError(f"{self.id} has no expression on its right side")
        return found

    @cached_property
    def where(self) -> Domain:
        """The domain, rebuilt."""
        return _domain(self.variables)

    @property
    def settled(self) -> bool:
        from xsec_sym.proof.verdict import SETTLED

        return self.verdict in SETTLED

    # --- display -----------------------------------------------------------------------------------

    def relation(self, side: str = "printed") -> str:
        """What stands between the two sides: "=", "≈" where they are only near, "≥" for an inequality.

        An inequality A >= B is kept as |A - B| = A - B.
        """
        if self.kind in ("approximation", "accuracy"):
            return "≈"
        right = getattr(self, side)
        return "≥" if right is not None and self.left == rf"\left|{{{right}}}\right|" else "="

    def latex(self, side: str = "printed") -> str:
        """The whole equation with its printed, or its corrected, right side."""
        from xsec_sym.record.relation import parts

        left, right = parts(self, side)
        return left if right is None else f"{left} {SIGNS[self.relation(side)]} {right}"

    def bibtex(self) -> str:
        """A BibTeX entry by which this verdict can be cited; `xsec_sym.record.sources.bibtex` has those of the sources.

        >>> from xsec_sym.record.store import Ledger
        >>> print(Ledger()["deon2016:9"].bibtex().splitlines()[0])
        @misc{xsec:deon2016:9,
        """
        from xsec_sym.record.sources import cite

        return cite(self)

    def nearness(self) -> str:
        """How near the sides are to each other, and how near they are said to be; empty for an equation."""
        from xsec_sym.record.relation import nearness

        return nearness(self)

    def heading(self, name: str) -> str:
        """What a side is called: it corrects something only where something is printed."""
        if self.printed is not None:
            return name
        return "statement" if name == "corrected" else "quantity"

    @property
    def wordless(self) -> bool:
        """Whether all is said in words: there is no formula to show."""
        return self.left in ("", "0") and self.printed is None and self.corrected is None

    def _repr_latex_(self) -> str:
        return rf"$\displaystyle {self.latex('printed' if self.corrected is None else 'corrected')}$"

    def _repr_html_(self) -> str:
        rows = [("printed", f"$\\displaystyle {escape(self.latex())}$")] if self.printed is not None else []
        if self.corrected is not None:
            rows.append((self.heading("corrected"), f"$\\displaystyle {escape(self.latex('corrected'))}$"))
        said = [
            ("edit", self.edit),
            ("near", self.nearness()),
            ("where", self.domain),
            ("reading", self.reading),
            ("note", self.note),
        ]
        if self.verdict == "confirmed" and self.digits:
            said.append(("digits", str(self.digits)))
        if self.witness:
            said.append(("fails at", ", ".join(f"{k}: {v}" for k, v in self.witness.items())))
        rows += [(name, escape(text)) for name, text in said if text]
        body = "".join(f"<tr><th>{name}</th><td style='text-align:left'>{text}</td></tr>" for name, text in rows)
        head = f"<b>{escape(self.id)}</b> {escape(self.title)}: <b>{self.verdict}</b>"
        return f"{head}<table>{body}</table>"

    def __str__(self) -> str:
        return f"{self.id} ({self.title}): {self.verdict}"


_TOLD = ("id", "source", "section", "label", "title", "kind", "edit", "reading", *SIDES, "domain", "parts", "encoded",
         "variables")  # fmt: skip


def encoded(value: Any) -> Any:
    """The expression as data, or None where it has no place in a record."""
    from xsec_sym.proof import wire

    try:
        return wire.encode(value)
    except TypeError:
        return None


def _decoded(data: Any) -> Any:
    import xsec_sym.exact  # noqa: F401  (its objects may occur)
    from xsec_sym.proof import wire

    return wire.decode(data)


def _domain_code(domain: Domain) -> dict[str, Any]:
    from xsec_sym.proof.domain import Choices, Interval

    ranges: list[Any] = []
    for v in domain.variables:
        if isinstance(v, Interval):
            ranges.append(["interval", *map(encoded, (v.symbol, v.low, v.high)), v.low_open, v.high_open])
        elif isinstance(v, Choices):
            ranges.append(["choices", *map(encoded, (v.symbol, *v.values))])
        else:
            ranges.append(["integers", encoded(v.symbol), v.low, v.step, v.high])
    return {"ranges": ranges, "conditions": [encoded(c) for c in domain.conditions]}


def _domain(data: dict[str, Any]) -> Domain:
    from xsec_sym.proof.domain import Choices, Domain, Integers, Interval

    variables: list[Any] = []
    for kind, symbol, *rest in data.get("ranges", []):
        if kind == "interval":
            variables.append(Interval(_decoded(symbol), _decoded(rest[0]), _decoded(rest[1]), rest[2], rest[3]))
        elif kind == "choices":
            variables.append(Choices(_decoded(symbol), tuple(_decoded(v) for v in rest)))
        else:
            variables.append(Integers(_decoded(symbol), *rest))
    return Domain(tuple(variables), tuple(_decoded(c) for c in data.get("conditions", [])))
