"""How many seeds and CPU hours an accuracy of G and D(ω) needs, estimated from a pilot ensemble.

`seeds` has the statistics, `quantities` what is planned at a point, `hours` the cost of a sample;
`report` joins them in a table.
"""

from grainmodes.planning.quantities import Plan, plan_point
from grainmodes.planning.report import report
from grainmodes.planning.seeds import SeedEstimate, seeds_needed

__all__ = ["Plan", "SeedEstimate", "plan_point", "report", "seeds_needed"]
