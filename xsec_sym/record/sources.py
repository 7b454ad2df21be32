"""The sources as a library knows them, and BibTeX for them, for the project and for single verdicts.

What could not be established of a source is left out, rather than guessed: the year of a brief that bears none, say.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from xsec_sym.record.entry import Entry


@dataclass(frozen=True)
class Publication:
    """A source: its title as printed, its authors in full, and what else a citation needs.

    about: what a reader is told in place of a title in another language. read: what the project read, where that is
    not the publication itself. fields: those of BibTeX, as they are written there.
    """

    key: str
    title: str
    authors: tuple[str, ...] = ()
    kind: str = "misc"
    fields: Mapping[str, str] = field(default_factory=dict)
    about: str = ""
    read: str = ""
    own: bool = False

    @property
    def short(self) -> str:
        """The authors with their given names as initials.

        >>> SOURCES["dupuy2016"].short, SOURCES["kenha2018"].short
        ('J. Dupuy, E. Heitz, E. d’Eon', '')
        """
        named = [a.split(" ", 1) for a in self.authors if " " in a]
        return ", ".join(f"{given[0]}. {family}".replace("'", "’") for given, family in named)


SOURCES = {
    p.key: p
    for p in (
        Publication(
            "deon2016",
            "The anisotropic cross-section for the spherical Gaussian medium",
            ("Eugene d'Eon",),
            fields={"howpublished": "Brief, 8i"},
        ),
        Publication(
            "dupuy2016",
            "Additional Progress Towards the Unification of Microfacet and Microflake Theories",
            ("Jonathan Dupuy", "Eric Heitz", "Eugene d'Eon"),
            "inproceedings",
            {
                "booktitle": r"Eurographics Symposium on Rendering -- Experimental Ideas \& Implementations",
                "editor": "Elmar Eisemann and Eugene Fiume",
                "publisher": "The Eurographics Association",
                "year": "2016",
                "pages": "55--63",
                "doi": "10.2312/sre.20161210",
            },
        ),
        Publication(
            "deon2021",
            "An analytic BRDF for materials with spherical Lambertian scatterers",
            ("Eugene d'Eon",),
            "article",
            {
                "journal": "Computer Graphics Forum (Proceedings of the Eurographics Symposium on Rendering)",
                "volume": "40",
                "number": "4",
                "pages": "153--161",
                "year": "2021",
                "eprint": "2103.01618",
                "archiveprefix": "arXiv",
            },
            read="a Japanese translation",
        ),
        Publication(
            "tokuyoshi_harada",
            "Derivation of a Squared Ellipsoidal Lobe Function",
            ("Yusuke Tokuyoshi", "Takahiro Harada"),
            fields={"howpublished": "Square Enix Co., Ltd. and Advanced Micro Devices, Inc."},
        ),
        Publication(
            "kenha2018",
            "マイクロファセット法線分布関数を作ってみる",
            ("kenha",),
            fields={"howpublished": "Article for the レイトレ Advent Calendar 2018, Qiita", "year": "2018"},
            about="A distribution of normals from the shape of a mirror of revolution",
        ),
        Publication("xsec", "Results of this project", own=True),
    )
}

# What TeX takes for its own. Letters of other alphabets are left to it.
_TEX = {
    "\\": r"\textbackslash{}", "{": r"\{", "}": r"\}", "$": r"\$", "&": r"\&", "%": r"\%", "#": r"\#", "_": r"\_",
    "^": r"\^{}", "~": r"\~{}", "<": "$<$", ">": "$>$",
}  # fmt: skip


def tex(text: str) -> str:
    r"""Plain words as TeX sets them.

    >>> tex("u_i^2 > 1 & more")
    'u\\_i\\^{}2 $>$ 1 \\& more'
    """
    return "".join(_TEX.get(c, c) for c in text)


def bibtex(key: str) -> str:
    """The BibTeX entry of a source; that of "xsec" cites this project. Raises KeyError for a source not known here.

    >>> print(bibtex("tokuyoshi_harada"))
    @misc{tokuyoshi_harada,
      author       = {Yusuke Tokuyoshi and Takahiro Harada},
      title        = {{Derivation of a Squared Ellipsoidal Lobe Function}},
      howpublished = {Square Enix Co., Ltd. and Advanced Micro Devices, Inc.},
    }
    """
    source = SOURCES[key]
    if source.own:
        return _project(key)
    said = {"author": " and ".join(source.authors), "title": f"{{{tex(source.title)}}}", **source.fields}
    if source.read:
        said["annote"] = f"xsec\\_sym read {source.read}"
    return _entry(source.kind, key, said)


def _project(key: str) -> str:
    from xsec_sym import __version__

    title = (
        "derivations and verdicts for cross-sections, lobes and shadowing functions of microfacet and microflake media"
    )
    return _entry(
        "misc", key, {"title": f"{{xsec\\_sym: {title}}}", "howpublished": f"Software, version {__version__}"}
    )


def cite(entry: Entry) -> str:
    """The BibTeX entry by which one verdict can be cited. It names the claim's key in the record, by which it is known
    which form of the claim was judged.

    >>> from xsec_sym.record.store import Ledger
    >>> cite(Ledger()["deon2016:18"]).splitlines()[0]
    '@misc{xsec:deon2016:18,'
    """
    from xsec_sym import __version__

    known = SOURCES.get(entry.source)
    if known is None or known.own:
        place = entry.source
    else:
        place = ", ".join(filter(None, (known.short.replace("’", "'"), f"``{known.title}''")))
    if entry.section and not (known and known.own):
        place += f", section {entry.section}" if entry.section[:1].isdigit() else f", {entry.section}"
    word = (
        f"{entry.verdict} to {entry.digits} digits" if entry.verdict == "confirmed" and entry.digits else entry.verdict
    )
    note = f"Verdict: {tex(word)}"
    note += f" ({tex(entry.edit)})" if entry.edit and entry.verdict == "misprint" else ""
    note += "" if known and known.own else f". On {tex(place)}"
    note += f". Record key {entry.key[:12]}" if entry.key else ""
    said = {
        "title": f"{{{tex(entry.id)}: {tex(entry.title)}}}",
        "howpublished": f"xsec\\_sym {__version__}, \\texttt{{xsec show {tex(entry.id)}}}",
        "note": note,
    }
    key = "".join(c if c.isalnum() or c in ":._-+" else "-" for c in entry.id)
    return _entry("misc", key if entry.source == "xsec" else f"xsec:{key}", said)


def _entry(kind: str, key: str, said: Mapping[str, str]) -> str:
    wide = max(map(len, said))
    return "\n".join([f"@{kind}{{{key},", *(f"  {name:<{wide}} = {{{text}}}," for name, text in said.items()), "}"])


def bibtex_of(name: str, record: Mapping[str, Entry]) -> str:
    """The BibTeX entry of an entry of the record, or of a source. Raises KeyError, with a sentence."""
    if name in record:
        return cite(record[name])
    if name not in SOURCES:
        raise KeyError(f"nothing is known of the source {name} that a bibliography could hold")
    return bibtex(name)
