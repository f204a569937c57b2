"""What a scene will cost, before anyone starts it: CPU time, memory and disk of every stage.

    CPU time = Σ over samples of Σ over works of (units of work) c (N / 1024)^p + jobs × start-up

`table` has c and p, measured on one machine, `work` the units that a stage asks for; `packings` and
`responses` count samples and jobs, `estimate` joins them, `report` says it in a table, and
`budget` refuses what no machine gives.
"""

from grainmodes.cost.budget import check_budget
from grainmodes.cost.estimate import estimate, wall_seconds
from grainmodes.cost.item import Item
from grainmodes.cost.report import report
from grainmodes.cost.table import COSTS, GrowthLaw, Table, read_table

__all__ = [
    "COSTS",
    "GrowthLaw",
    "Item",
    "Table",
    "check_budget",
    "estimate",
    "read_table",
    "report",
    "wall_seconds",
]
