"""A culture: groups that breeds with different schemes form together."""

from __future__ import annotations

from collections.abc import Iterable

from coglogo_py.border.closed import Closed
from coglogo_py.border.errors import CogLogoError
from coglogo_py.laying_out import group_types
from coglogo_py.scheme import CognitiveScheme
from coglogo_py.society import Society


class Culture(Closed):
    """Several breeds, each a `Society` with a scheme of its own, that share their groups.

    Groups of the same name are one type. Its instances, their identities, members and culturons
    are those of all breeds; which plans a culturon acts on is what each breed's scheme says.

    Args:
        schemes: of the breeds, one after another.
        seed: as of a `Society`.
        stream: likewise.

    Raises:
        CogLogoError: a scheme is none, or two of them disagree on where a culturon starts.

    >>> from coglogo_py import Culturon, Group, Role
    >>> law = Culturon("Law", 2, influence={"work": 3}, conditional=("work",))
    >>> lords = CognitiveScheme("lords", groups=(Group("village", (Role("chief"),)),))
    >>> folk = CognitiveScheme("folk", groups=(Group("village", (Role("member", (law,)),)),))
    >>> culture = Culture((lords, folk), seed=1)
    >>> lord, peasant = (breed.new_mind() for breed in culture.breeds)
    >>> lord.create_and_join_group("village", "chief")
    True
    >>> peasant.join_group("village", "member", lord.get_group_id("village"))
    True
    >>> lord.set_culturon_value("village", "Law", 5)
    >>> peasant.plan_weights()
    {'work': 15.0}
    """

    def __init__(self, schemes: Iterable[CognitiveScheme], seed: int, stream: int = 0) -> None:
        self.schemes = tuple(schemes)
        for scheme in self.schemes:
            if not isinstance(scheme, CognitiveScheme):
                raise CogLogoError(
                    f"a culture needs a CognitiveScheme of each breed, found {scheme!r}; "
                    "load one with CognitiveScheme.load(path)"
                )
        if not self.schemes:
            raise CogLogoError("a culture without breeds; give it the scheme of each breed")
        self.types = group_types(self.schemes)
        cognitons = max(len(scheme.cognitons) for scheme in self.schemes)
        self.breeds = tuple(
            Society(scheme, seed, stream, (self.types, cognitons, breed))
            for breed, scheme in enumerate(self.schemes)
        )
        for breed in self.breeds:
            breed.sharing, breed.minds = self.breeds, self.breeds[0].minds
        self._closed = True
