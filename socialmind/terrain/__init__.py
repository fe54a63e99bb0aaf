"""Ground that is easy, hard or impossible to cross: rules for walking over it.

Plain functions that rules call at both speeds, as those of `socialmind.economy`.
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from socialmind.terrain.ground import Ground as Ground
    from socialmind.terrain.ground import wear_off as wear_off
    from socialmind.terrain.walking import step_ahead as step_ahead
    from socialmind.terrain.walking import step_towards as step_towards
else:
    from coglogo_py.on_demand import on_demand

    __getattr__, __dir__, __all__ = on_demand(
        __name__,
        {
            "socialmind.terrain.ground": "Ground wear_off",
            "socialmind.terrain.walking": "step_ahead step_towards",
        },
    )
