"""Is it true? Symbolic proof, enclosures, digits, mutants and certificates. Nothing here knows a paper."""

from xsec_sym.proof.claim import REGISTRY, Claim, Source
from xsec_sym.proof.domain import EmptyDomain, integers, interval, parity
from xsec_sym.proof.regular import Refused
from xsec_sym.proof.steps import Step

__all__ = ["REGISTRY", "Claim", "EmptyDomain", "Refused", "Source", "Step", "integers", "interval", "parity"]
