"""Whether a packing has enough contacts to be rigid, by counting (Maxwell).

A backbone of N' grains with C contacts, under pressure, which fixes the size of its box, needs

    without friction    C ≥ 2N' − 1       one force per contact, two degrees of freedom per grain
    with friction       2C ≥ 3N' − 1      two forces per contact, three degrees of freedom

Friction counts where springs are loaded. Then two contacts can hold a grain.
"""

from __future__ import annotations

from grainmodes.packing.state import Packing, backbone


def most_contacts_of_rattler(packing: Packing) -> int:
    """Largest number of contacts of a grain that carries no load."""
    return 2 if packing.history is None else 1


def may_be_rigid(packing: Packing) -> bool:
    """Whether the backbone of a packing has the contacts that a rigid one needs.

    Raises:
        PackingError: two grains lie at the same place.
    """
    rigid = backbone(packing, most_contacts_of_rattler(packing))
    if packing.history is None:
        return rigid.n > 0 and len(rigid.contacts.i) >= 2 * rigid.n - 1
    return rigid.n > 0 and 2 * len(rigid.contacts.i) >= 3 * rigid.n - 1
