"""Tables of the pages that are counted from the record: `python -m tests.docs.tables` writes them anew."""

import re
from collections import Counter
from pathlib import Path

from xsec_sym.record.store import Ledger

ROOT = Path(__file__).parents[2]
SHOWN = ("proved", "confirmed", "misprint", "claim-holds", "claim-fails", "divergent", "definition", "out-of-scope")
PAPERS = {
    "deon2016": "E. d'Eon, *The anisotropic cross-section for the spherical Gaussian medium*",
    "dupuy2016": "J. Dupuy, E. Heitz, E. d'Eon, *Additional Progress Towards the Unification of Microfacet and "
    "Microflake Theories*",
    "deon2021": "E. d'Eon, *An analytic BRDF for materials with spherical Lambertian scatterers*",
    "tokuyoshi_harada": "Y. Tokuyoshi, T. Harada, *Derivation of a Squared Ellipsoidal Lobe Function*",
    "kenha2018": "distributions of normals from mirrors of revolution",
    "xsec": "the project's own results",
}


def counts(record):
    """How many entries of each source carry each verdict; none is left out."""
    total = Counter(e.verdict for e in record.values())
    words = [*SHOWN, *sorted(set(total) - set(SHOWN))]
    lines = ["| key | source | entries | " + " | ".join(words) + " |", "|---|---" + "|---:" * (len(words) + 1) + "|"]
    for key in [*PAPERS, *(s for s in record.sources if s not in PAPERS)]:
        found = Counter(e.verdict for e in record.source(key))
        cells = [str(found[w] or "") for w in words]
        lines.append(f"| `{key}` | {PAPERS.get(key, key)} | {found.total()} | {' | '.join(cells)} |")
    return [*lines, f"| | all | {len(record)} | {' | '.join(str(total[w] or '') for w in words)} |"]


def fails(record):
    found = [e for key in [*PAPERS, *record.sources] for e in record.values() if e.source == key]
    rows = dict.fromkeys(f"| `{e.id}` | {e.title} |" for e in found if e.verdict == "claim-fails")
    return ["| id | what is said |", "|---|---|", *rows]


TABLES = {"counts": ("README.md", counts), "fails": ("docs/findings.md", fails)}


def renewed(page, name, lines):
    """The page with the lines between the marks of this name."""
    mark = re.compile(rf"(<!-- {name}: [^>]*-->\n).*?(<!-- /{name} -->)", re.S)
    found, count = mark.subn(lambda m: m[1] + "".join(line + "\n" for line in lines) + m[2], page)
    assert count == 1, f"the page has no place for {name}"
    return found


if __name__ == "__main__":
    for name, (path, table) in TABLES.items():
        page = ROOT / path
        page.write_text(renewed(page.read_text(encoding="utf-8"), name, table(Ledger())), encoding="utf-8")
