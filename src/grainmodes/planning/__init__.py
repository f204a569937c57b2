"""How many seeds, and CPU hours, an accuracy of G and D(ω) needs, from a pilot ensemble.

`seeds` has the statistics, `quantities` what is planned at a point, `hours` what a sample costs,
`report` joins them in a table.
"""

from grainmodes.planning.quantities import Plan, planned
from grainmodes.planning.report import report
from grainmodes.planning.seeds import Need, needed

__all__ = ["Need", "Plan", "needed", "planned", "report"]
