import pytest
from sympy import Symbol

from xsec_sym.proof import REGISTRY, Source, interval
from xsec_sym.proof.verdict import Verdict

u = Symbol("u", real=True)


def certificate(name, *lemmas):
    return {"format": 1, "claim": name, "moves": [["lemma", {"proven": other}] for other in lemmas] + [["close", {}]]}


@pytest.fixture
def source():
    """A source with four claims, two of them the parts of a whole, that leaves no trace in the registry."""
    before = dict(REGISTRY)
    paper = Source("sample", section="3")
    for k in (1, 2, 3):
        paper.claim(str(k), f"power {k}", left=u * u**k, printed=u ** (k + 1), where=[interval(u, 0, k)])
    paper.whole("4", "both", ["1", "2"], left=u)
    yield paper
    REGISTRY.clear()
    REGISTRY.update(before)


@pytest.fixture
def claims(source):
    return {c.id: c for c in source}


def stand_in_for_engine(monkeypatch):
    """Puts verdicts in place of the proof engine's; the returned dict maps ids to them, or to calls that make them."""
    from xsec_sym.proof import verify

    says = {}

    def stand_in(claim, claims, *, digits=30, seed=0, witnesses=20, certificate=None):
        said = says.get(claim.id, Verdict("proved"))
        said = said() if callable(said) else said
        return said if said.verdict != "proved" or said.note else Verdict(
            "proved", digits=digits, certificate=said.certificate, note=said.note,
            mutants=0 if certificate else said.mutants,
            evidence={"witnesses": witnesses, "replayed": certificate is not None}, steps=((0, "shown"),))  # fmt: skip

    monkeypatch.setattr(verify, "verify", stand_in)
    return says


@pytest.fixture
def engine(monkeypatch):
    return stand_in_for_engine(monkeypatch)
