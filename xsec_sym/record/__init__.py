"""Every equation and its verdict, as data: the object `ledger`."""

from xsec_sym.record.entry import Entry
from xsec_sym.record.store import Ledger, UnknownEntry, ledger

__all__ = ["Entry", "Ledger", "UnknownEntry", "ledger"]
