# yade-blocks, GPL-2.0-or-later
"""The laboratory in which the library is measured: studies, trade-offs, calibrations, counted instructions. Not installed."""
