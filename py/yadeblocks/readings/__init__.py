# yade-blocks, GPL-2.0-or-later
"""What pictures, files and results read of a BlockModel or of a Snapshot of one; a file for each kind of thing."""
