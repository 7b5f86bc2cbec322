# yade-blocks, GPL-2.0-or-later
"""YADE itself, with nothing to do: from the command to the end of the first step, for cost.py."""
import json
import os
import time

from yade import *

O.run(1, True)
print("COST " + json.dumps(dict(start_s=time.monotonic() - float(os.environ["BEGUN"]))))
