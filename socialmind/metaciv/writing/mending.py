"""Which faults of MetaCiv's program a model would meet, and what is done here instead."""

from __future__ import annotations

from collections.abc import Iterator

from socialmind.metaciv.actions import STAYING
from socialmind.metaciv.description import Action
from socialmind.metaciv.writing.model_file import ModelFile
from socialmind.metaciv.writing.scheme_file import chosen_plans, culturons


def mended(file: ModelFile) -> list[str]:
    """Return the faults of MetaCiv's program that this model would meet, and what is done here."""
    names = _actions(file)
    people, sheet = file.people, file.sheet
    cognitons = list(people.cognitons.values())
    permitted = [p.plan for one in cognitons for p in one.permits]
    maker = file.model.parameters.decision_maker
    comparators = {str(one.value) for action in _all_actions(file) for one in action.arguments
                   if one.type == "Comparator"}  # fmt: skip
    inline = _inline_names(file)
    said = [
        (True, "Luck is keyed by the seed: a run can be repeated. There it has none."),
        (True, "An agent without a plan does nothing in that tick; there any error kills it."),
        (any(one.kind == "birth" for one in people.plans.values()),
         "The plan of birth runs once; there its first action runs again in the first step."),
        (len(permitted) != len(set(permitted)),
         "A plan is available while anything permits it; there it is lost with the first cogniton "
         "that permits it."),
        (bool(people.groups) and bool(culturons(sheet)),
         "Who leaves a role loses the plans that it permits; there they stay."),
        (any(one.triggers for one in cognitons),
         "Triggers compare at birth and whatever changes the attribute; there they see crossings "
         "by actions alone, and `==` never brings anything."),
        (maker == "WeightedStochastic",
         "Plans are drawn by their weights as they are; there weights are cut to whole numbers. "
         "Where none is above 0, the largest one wins; there the agent dies."),
        (maker == "MaxWeightOx2",
         "A plan that takes over begins from its start; there the old one plays on under its "
         "name."),
        ("L_Repeat" in names,
         "`L_Repeat` plays its children n times in order; there the first one comes once too "
         "often, then all come backwards, and a nested one ends the plan."),
        ("L_MultipleActions" in names,
         "`L_MultipleActions` plays both children in order; there backwards, after an idle tick."),
        (bool({"L_IsPrivateFacilityHere", "L_IsChefFacilityHere"} & names),
         "One branch of `L_IsPrivateFacilityHere` runs; there the second always does."),
        ("L_EveryXTick" in names,
         "Each `L_EveryXTick` counts for itself; there all share a counter."),
        (bool(inline & STAYING),
         "Actions that go on until they are done make one step where all happens at once."),
        ("==" in comparators, "`==` compares numbers; there it is never true."),
        (bool({"A_ReplaceCognitonWeight", "A_ChangeCognitonWeightOneTick"} & names),
         "Weights of plans always follow the values of cognitons; there some actions pass "
         "unnoticed."),
        (bool(file.model.effects) and bool(sheet.carried),
         "Effects keep fractions, and what is not permanent is undone with its object, for "
         "attributes too."),
        ("A_WithdrawObjectFromFacilityHere" in names,
         "`A_WithdrawObjectFromFacilityHere` gives; there the stock reads as 0."),
        (any(one.facility.recipe for one in sheet.used_facilities),
         "What a facility is built of is used up; there it is only looked for."),
        (bool({"A_ErasePrivateFacility"} & names), "A facility that is erased is forgotten."),
        (bool({"A_ChangeRoleForAnother", "A_AskRandomMemberToChangeRoleForAnother"} & names),
         "Who changes role stays in its group; there the last member kills it by that."),
        (bool({"L_CompareRoleMembers"} & names), "All roles of a group are counted; there one is."),
        (bool({"A_Trade", "A_TravelTrade", "I_Commercer_Repondu"} & names),
         "A swap takes place if both have what they give; there goods come from nothing."),
        ("I_Attaquer" in names,
         "Whoever attacks lives on; there an attack on somebody who was born in the run kills the "
         "attacker."),
        ("messages" in sheet.needs,
         "A message arrives in the tick after it was sent, whoever acts first."),
        ("walk" in sheet.needs,
         "Agents go from patch to patch; there by real coordinates, where a step may stay in the "
         "patch. Nobody enters what is impassable."),
        ("ways" in sheet.needs,
         "Ways are cheapest ones and lead round the torus; there they are nearly greedy, and "
         "searches may not end."),
        (_same_colours(file),
         "Terrains are told by their names; there those of one colour are one."),
        (bool(names & {"L_CompareCogniton", "A_DisbandGroup", "L_IsGroupFacilityHere",
                       "L_CompareEfficacite", "L_AttackerGotTag"}),
         "A condition on what is not there is false, and an act on it does nothing; there the "
         "agent dies."),
        (any(one.start_chance for one in cognitons) and not file.model.older,
         "`StartChance` has no effect, as there."),
        *_of_files(file),
    ]  # fmt: skip
    return [text for holds, text in said if holds]


def _of_files(file: ModelFile) -> Iterator[tuple[bool, str]]:
    """Return what is mended in reading the files."""
    model = file.model
    named = [
        argument.value
        for action in _all_actions(file)
        for argument in action.arguments
        if argument.type not in ("String", "Comparator")
    ]
    yield True, "Files come sorted by name; there as the system has them."
    yield (
        any(isinstance(one, str) and " " in one for one in named),
        "Names with blanks may be arguments; there they end at the first blank.",
    )
    yield (
        any(one.recipe for one in model.facilities),
        "Recipes of facilities are read; there they stop the program.",
    )
    yield (
        "." in model.parameters.map.removesuffix(".metaciv"),
        "The map's name may have dots; there it ends at the first.",
    )


def _all_actions(file: ModelFile) -> Iterator[Action]:
    used = set(chosen_plans(file.sheet))
    for plan in file.people.plans.values():
        if plan.kind != "plan" or plan.name in used:
            for action in plan.actions:
                yield from action.all()


def _actions(file: ModelFile) -> set[str]:
    return {one.name for one in _all_actions(file)}


def _inline_names(file: ModelFile) -> set[str]:
    """Return the names of actions that happen at once with others."""
    found = set()
    for plan in file.people.plans.values():
        for action in plan.actions:
            for one in action.all():
                if plan.kind != "plan":
                    found.add(one.name)
                elif one.name == "L_Instant":
                    found |= {inner.name for inner in one.all()}
    return found


def _same_colours(file: ModelFile) -> bool:
    colours = [one.colour for one in file.map.terrains if one is not None]
    return len(colours) != len(set(colours))
