"""The record as a static site, readable offline: `build` writes it."""

from xsec_sym.report.site import NotAReport, build

__all__ = ["NotAReport", "build"]
