"""What may have been meant by a name that is not there, for the end of the sentence that says so."""

from __future__ import annotations

from collections.abc import Iterable


def entry(name: str, known: Iterable[str], sources: Iterable[str], derivations: str | None = None) -> str:
    """For a name of which the record, or the folder of the user's own beside it, has no entry.

    >>> entry("deon2016:2", ["deon2016:22"], ["deon2016"])
    '; did you mean deon2016:22?'
    """
    from xsec_sym.record.store import nearest
    from xsec_sym.study.method import HOMES

    if name in HOMES:
        return f", but a quantity: xsec chart {name}"
    if hint := nearest(name, known):
        return hint
    if derivations is not None:
        return f"; if it is claimed in {derivations}, record it first: xsec verify --derivations {derivations} --record"
    if name.partition(":")[0] in sources:
        return ""
    return (
        "; if it is of a folder of your own, name that by --derivations PATH, "
        "once it is recorded by xsec verify --derivations PATH --record"
    )


def claim(name: str, known: Iterable[str], sources: Iterable[str]) -> str:
    """For a name that no derivation claims.

    >>> claim("deon2016", [], ["deon2016"])
    ', but a source: --source deon2016'
    """
    from xsec_sym.record.store import nearest

    return f", but a source: --source {name}" if name in sources else nearest(name, known)


def exported(names: Iterable[str]) -> str:
    """For kernels made by hand, which are not exported: what else writes a module of them.

    >>> exported(["deon2016:11", "lambda_beckmann"])
    '; xsec plan writes a module of it for a scene'
    """
    from xsec_sym.export.recipes import RECIPES
    from xsec_sym.study.method import HOMES

    return "; xsec plan writes a module of it for a scene" * any(n in HOMES and n not in RECIPES for n in names)
