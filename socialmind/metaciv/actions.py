"""The kinds of MetaCiv's actions as data: names, arguments, children."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Literal, NamedTuple

_KINDS = """
A_AccepterCommerce
A_AccepterEmbauche
A_AddCogniton(Cogniton)
A_AddItem(Objet, Integer C)
A_AddObjectXCogniton(Objet, Double, Integer, Cogniton)
A_AskRandomMemberToChangeRoleForAnother(GroupAndRole)
A_AvanceAleatoirement
A_BirthGroupAndRole(GroupAndRole)
A_BroadcastMessage_Commerce(Integer)
A_BroadcastMessage_Commerce_SiObjet(Objet, Integer)
A_BroadcastMessage_Embauche(Integer)
A_ChangeAttribute(Attribute, Integer C)
A_ChangeAttributeDouble(Attribute, Double C)
A_ChangeCognitonWeight(Cogniton, Double)
A_ChangeCognitonWeightInteger(Cogniton, Double)
A_ChangeCognitonWeightOneTick(Cogniton, Double)
A_ChangeRoleForAnother(GroupAndRole)
A_Collect(Pheromone, Double)
A_CollectFromFacilityEfficacite(Objet, Integer C)
A_CreateElectedGroup(GroupAndRole, GroupAndRole, Cogniton, Integer)
A_CreateGroup(GroupAndRole)
A_CreateGroupFacility(Amenagement, Group)
A_CreateObject(Objet)
A_CreatePrivateFacility(Amenagement)
A_CreatePrivateFacility_Efficacite(Amenagement)
A_DecrementerAmenagement
A_DepositObjectInFacilityHere(Objet, Integer C, Amenagement)
A_Die
A_DisbandGroup(Group|GroupAndRole)
A_DoNothing
A_DropItem(Objet, Integer C)
A_DropObject(Objet, Integer)
A_DropObjectAndChangeAttribute(Objet, Integer, Attribute, Double)
A_EmitCogniton(Cogniton, Double)
A_EmptyAndEraseGroupFacility(Amenagement, Group|GroupAndRole)
A_ErasePrivateFacility(Amenagement)
A_FollowRoleInGroup(GroupAndRole)
A_GetCibleInteraction_Tag(Attribute)
A_GetObject(Objet, Integer)
A_GoToAmenagement(Amenagement)
A_GoToChefFacility(Amenagement)
A_GoToClosestGroupFacility(Amenagement, Group)
A_GoToPrivateFacility(Amenagement)
A_GoToTarget
A_HireForRole(GroupAndRole)
A_Move
A_Move_Cardinals_Random
A_PartagerRessourceEmployes(Objet, Integer C)
A_RemoveItem(Objet, Integer C)
A_Rentrer
A_ReplaceCognitonWeight(Cogniton, Double)
A_SearchForRessources(Pheromone)
A_SetCibleInteractionInitiateur
A_SetEnMissionTrue
A_SetPoissonLaw(Attribute)
A_SetStrikeValue(Integer C)
A_SetTargetToClosestEmptyPatch
A_SmellAndMove(Pheromone)
A_Trade(turns Integer, itemToGive Objet, nItemToGive Integer, itemToTake Objet, \
nItemToTake Integer, myTag String, compatibleTag String)
A_Transform(Pheromone, Objet)
A_Transformer(Pheromone, Objet)
A_TravelTrade(turns Integer, itemToGive Objet, nItemToGive Integer, itemToTake Objet, \
nItemToTake Integer, myTag String, compatibleTag String)
A_UseAmenagement(Amenagement)
A_UseObject(Objet, Integer)
A_WithdrawObjectFromFacilityHere(Objet, Integer C, Amenagement)
A_killOtherAgentOnPatchThatIsNotInMyGroup
I_Attaquer(Attribute)
I_Commercer_Repondu(objectToGive Objet, nObjectToGive Integer C, objectToTake Objet, \
nObjectToTake Integer C)
I_GiveItemToChef(Objet, Integer C)
I_ModifierCognitonsEmployee(Cogniton, Double)
I_RejoindreGroupe
I_TakeItemsFromChef(Objet, Integer C)
L_ADesEmployes
L_AEmployeeEnMission
L_ARequeteCommerce
L_ARequeteEmbauche
L_AUnChef
L_AttackerGotTag(Attribute)
L_CheckStrikeValue(Comparator, Integer C)
L_CompareAmenagementObject(Amenagement, Objet, Comparator, Double)
L_CompareAttribute(Attribute, Comparator, Double C)
L_CompareCogniton(Cogniton, Comparator, Double)
L_CompareEfficacite(Comparator, Double)
L_CompareGroupAttributeToPopulation(Attribute, Comparator)
L_CompareNObject(Objet, Comparator, Integer C)
L_CompareNombreObjets(Objet, Comparator, Double C)
L_CompareNombreObjetsInGroupAmenagement(Amenagement, Objet, Comparator, Double)
L_CompareObject(Objet, Comparator, Double)
L_ComparePhero(Pheromone, Comparator, Double)
L_CompareResource(Pheromone, Comparator, Double)
L_CompareRoleMembers(GroupAndRole, Comparator, Double)
L_EveryXTick(Integer)
L_GotTargetInteraction
L_Instant
L_IsAnyFacilityHere
L_IsAttacked
L_IsChefFacilityHere(Amenagement)
L_IsCounterAtZero
L_IsFacilityInGroup(Amenagement, Group)
L_IsGroupFacilityHere(Amenagement, Group)
L_IsInGroup(Group)
L_IsInThatGroupInThatRole(GroupAndRole)
L_IsOnTerrain(Terrain)
L_IsPrivateFacilityHere(Amenagement)
L_MultipleActions
L_OwnCogniton(Cogniton)
L_OwnItem(Objet)
L_OwnObject(Objet)
L_OwnPrivateFacility(Amenagement)
L_RandomPercent(Double C)
L_Repeat(Integer)
"""
"""Name and arguments, each `[label ]type[|type][ C]`; C: a constant may stand for the number."""

OLD_NAMES = {
    "A_CreateAmenagement": "A_CreatePrivateFacility",
    "L_IsAmenagementHere": "L_IsPrivateFacilityHere",
    "L_IsAnyAmenagementHere": "L_IsAnyFacilityHere",
    "L_OwnAmenagement": "L_OwnPrivateFacility",
}
"""Names of before 2017 and the kind of the same meaning."""

STAYING = frozenset(
    (
        "A_GoToAmenagement", "A_GoToClosestGroupFacility", "A_GoToTarget", "A_Rentrer",
        "A_SearchForRessources", "A_Trade", "A_TravelTrade",
    )
)  # fmt: skip
"""Actions that go on, tick by tick, until they are done."""

DIRECTIONS = ("NORTH", "EAST", "SOUTH", "WEST")
COMPARATORS = (">", ">=", "==", "<=", "<")


class Parameter(NamedTuple):
    """What an action wants.

    Args:
        types: of the argument, any of these.
        heeds_constants: whether a constant of the scheme may stand for the number.
        label: which tells it apart; empty where the type does.
    """

    types: tuple[str, ...]
    heeds_constants: bool = False
    label: str = ""


@dataclass(frozen=True, slots=True)
class Kind:
    """A kind of action.

    Args:
        name: as in plans.
        arguments: what it wants, in this order.
        children: what it does with them: "none"; "branches", the first if it is true, the second
            if not; "all", one after another.
        stays: whether it takes as many ticks as it needs.
    """

    name: str
    arguments: tuple[Parameter, ...]
    children: Literal["none", "branches", "all"]
    stays: bool

    @property
    def is_condition(self) -> bool:
        """Whether it asks something, in the tick of what follows."""
        return self.name.startswith("L_") and self.children == "branches"

    @property
    def has_direction(self) -> bool:
        """Whether a direction is written behind its name."""
        return self.name in ("A_Move", "A_Move_Cardinals_Random")

    @property
    def most_children(self) -> int | None:
        """How many children count; None for all."""
        if self.name == "L_EveryXTick":
            return 1
        if self.name == "L_MultipleActions":
            return 2
        return {"none": 0, "branches": 2, "all": None}[self.children]


def _kind(line: str) -> Kind:
    name, _, inside = line.rstrip(")").partition("(")
    arguments = []
    for words in (one.split() for one in inside.split(", ") if one):
        constant = words[-1] == "C"
        *label, types = words[:-1] if constant else words
        arguments.append(Parameter(tuple(types.split("|")), constant, "".join(label)))
    if name in ("L_Instant", "L_MultipleActions", "L_Repeat"):
        children: Literal["none", "branches", "all"] = "all"
    else:
        branches = name.startswith("L_") or name in ("A_Trade", "A_TravelTrade")
        children = "branches" if branches else "none"
    return Kind(name, tuple(arguments), children, name in STAYING)


ACTIONS = {kind.name: kind for kind in map(_kind, re.findall(r".+", _KINDS))}
"""The kinds of actions by name."""


def kind_called(name: str) -> Kind | None:
    """Return the kind of a name, also of an old one.

    >>> kind_called("L_OwnAmenagement").name
    'L_OwnPrivateFacility'
    >>> kind_called("A_AddItem").arguments[1]
    Parameter(types=('Integer',), heeds_constants=True, label='')
    """
    return ACTIONS.get(OLD_NAMES.get(name, name))
