# yade-blocks, GPL-2.0-or-later
"""Scenarios under yade-batch."""
import os
import re

from .parsing import ParameterError


def waitIfBatch():
	"""Under yade-batch, waits until a simulation running in the background has ended; else returns at once."""
	if "YADE_BATCH" in os.environ:
		from yade import utils
		utils.waitIfBatch()


def batchLine(known):
	"""The line of the parameter table that yade-batch has chosen for this job: key -> text.

	utils.readParamsFromTable would evaluate the texts as Python, so that case=TT1 were an undefined name and * an error;
	here they mean what they mean on the command line. It leaves the same tags behind."""
	place = os.environ.get("YADE_BATCH")
	if not place:
		return {}
	from yade import utils
	from yade.wrapper import Omega
	table, _, line = place.rpartition(":")
	texts = utils.TableParamReader(table).paramDict().get(int(line))
	if texts is None:
		raise ParameterError(f"YADE_BATCH must name a line with parameters, got {place}")
	description, tags = texts.pop("description"), Omega().tags
	texts = {key: text for key, text in texts.items() if key[0] != "!" and text != "*"}
	tags["line"], tags["description"] = "l" + line, description
	tags["d.id"], tags["id.d"] = description + "." + tags["id"], tags["id"] + "." + description
	tags["params"] = ",".join(f"{key}={text}" for key, text in texts.items())
	if "tag" in known: # jobs of one table must not share a folder
		texts.setdefault("tag", re.sub(r"[^\w.,=+-]", "_", description))
	return texts
