"""Facilities and groups of imported models, worked out by hand."""

from .folders import files_of, followed, imported

ADD = "A_AddItem,o(Objet {}),n(Integer {} Constant __NoConstant)"
WILL = {"Will": (True, "Work", {"Work": 1})}
VILLAGE = "Culturon : chief,Lead\nCulturon : member,Follow\nAutoJoin : {}\n"
CULTURONS = {"Lead": (False, "", {}), "Follow": (False, "", {})}


def test_a_private_facility_is_built_of_its_recipe_once_and_keeps_what_is_put_in(tmp_path):
    model = imported(
        tmp_path,
        files_of(
            plans={
                "Work": f"""
A_CreatePrivateFacility,a(Amenagement Barn)
{ADD.format("Wood", 5)}
A_CreatePrivateFacility,a(Amenagement Barn)
A_CreatePrivateFacility,a(Amenagement Barn)
A_DepositObjectInFacilityHere,o(Objet Wood),n(Integer 2 Constant __NoConstant),a(Amenagement Barn)
A_WithdrawObjectFromFacilityHere,o(Objet Wood),n(Integer 7),a(Amenagement Barn)
L_IsPrivateFacilityHere,a(Amenagement Barn)
  A_Move,NORTH
  A_AddItem,o(Objet Loss),n(Integer 1)
L_IsPrivateFacilityHere,a(Amenagement Barn)
  A_AddItem,o(Objet Loss),n(Integer 1)
  A_GoToPrivateFacility,a(Amenagement Barn)
A_ErasePrivateFacility,a(Amenagement Barn)
L_OwnPrivateFacility,a(Amenagement Barn)
  A_AddItem,o(Objet Loss),n(Integer 1)
  A_AddItem,o(Objet Gain),n(Integer 1)
"""
            },
            cognitons=WILL,
            objects=("Wood", "Gain", "Loss"),
            facilities=("Barn",),
            recipes={"Barn": {"Wood": 2}},
        ),
    )
    found = followed(model, 10, "wood", "gain", "loss", "y")
    assert [one[0] for one in found] == [0, 5, 3, 3, 1, 3, 3, 3, 3, 3]
    assert found[-1][1:3] == (1, 0)
    assert [one[3] for one in found] == [3.0] * 6 + [0.0] + [3.0] * 3
    society = model(seed=1, compiled=False)
    society.advance(8)
    assert [(one.wood, one.owner) for one in society.barns] == [(0, 0)]
    society.advance(3)
    assert len(society.barns) == 0


def test_a_village_shares_what_it_builds_and_loses_it_with_its_last_member(tmp_path):
    model = imported(
        tmp_path,
        files_of(
            plans={
                "Work": f"""
A_CreateGroup,g(GroupAndRole Village:chief)
{ADD.format("Wood", 9)}
A_CreateGroupFacility,a(Amenagement Barn),g(Group Village)
L_IsGroupFacilityHere,a(Amenagement Barn),g(Group Village)
  A_Move,EAST
A_Move,EAST
L_IsFacilityInGroup,a(Amenagement Barn),g(Group Village)
  A_GoToClosestGroupFacility,a(Amenagement Barn),g(Group Village)
A_BirthGroupAndRole,g(GroupAndRole Village:member)
L_CompareRoleMembers,g(GroupAndRole Village:member),c(Comparator ==),n(Double 1.0)
  A_AskRandomMemberToChangeRoleForAnother,g(GroupAndRole Village:chief)
A_DisbandGroup,g(Group Village)
"""
            },
            cognitons={**WILL, **CULTURONS},
            groups={"Village": VILLAGE.format("false,null")},
            objects=("Wood",),
            facilities=("Barn",),
            recipes={"Barn": {"Wood": 4}},
        ),
    )
    society = model(seed=1, compiled=False)
    society.advance(5)
    assert society.humans[0].wood == 5
    assert [(one.x, one.y, one.owner) for one in society.barns] == [(2.0, 3.0, -1)]
    places = []
    for _ in range(5):
        society.advance(1)
        places.append(society.humans[0].x)
    assert places == [3.0, 4.0, 3.0, 2.0, 2.0]  # it notices in a tick that it has arrived
    society.advance(1)
    child = society.humans[1]
    assert child.mind.get_group_role_id("Village", "member") >= 0
    society.advance(1)
    assert child.mind.get_group_role_id("Village", "chief") >= 0
    society.advance(1)
    assert len(society.barns) == 0
    assert child.mind.get_group_id("Village") == -1


def test_efficient_facilities_are_worked_at_until_they_are_ready(tmp_path):
    model = imported(
        tmp_path,
        files_of(
            plans={
                "Work": """
A_SetStrikeValue,n(Integer 40)
A_CreatePrivateFacility_Efficacite,a(Amenagement Field)
L_Repeat,n(Integer 3)
  L_IsCounterAtZero
    A_CollectFromFacilityEfficacite,o(Objet Corn),n(Integer 3)
    A_DecrementerAmenagement
L_CompareEfficacite,c(Comparator >=),n(Double 0.0)
  A_AddItem,o(Objet Gain),n(Integer 1)
L_CheckStrikeValue,c(Comparator ==),n(Integer 40)
  A_AddItem,o(Objet Gain),n(Integer 1)
"""
            },
            cognitons=WILL,
            objects=("Corn", "Gain"),
            facilities=("Field",),
        ),
    )
    society = model(seed=1, compiled=False)
    society.advance(4)
    (field,) = society.fields
    assert 0 <= field.efficiency < 100 and field.counter == field.efficiency
    corn, counter = 0, field.efficiency
    for _ in range(3):
        society.advance(1)
        corn, counter = (corn + 3, field.efficiency) if counter <= 0 else (corn, counter - 40)
        assert (society.humans[0].corn, field.counter) == (corn, counter)
    society.advance(2)
    assert society.humans[0].gain == 2


def test_all_of_a_civilisation_join_one_village_and_children_too(tmp_path):
    model = imported(
        tmp_path,
        files_of(
            plans={"Work": "A_BirthGroupAndRole,g(GroupAndRole Village:chief)\nA_Die"},
            cognitons={**WILL, **CULTURONS},
            groups={"Village": VILLAGE.format("true,member")},
            agents=3,
        ),
    )
    society = model(seed=1, compiled=False)
    society.advance(3)
    ids = {one.mind.get_group_id("Village") for one in society.humans}
    assert len(society.humans) == 6 and len(ids) == 1
    assert all(one.mind.get_group_role_id("Village", "member") >= 0 for one in society.humans)
    society.advance(1)
    assert len(society.humans) == 9  # the dying can be met until their next turn
    society.advance(1)
    assert len(society.humans) == 9
    assert min(one.id for one in society.humans) == 3


def test_facility_of_a_chosen_name_and_goals(tmp_path):
    model = imported(
        tmp_path,
        files_of(
            plans={
                "Work": """
A_CreatePrivateFacility,a(Amenagement Hut)
A_SetTargetToClosestEmptyPatch
A_GoToTarget
A_Rentrer
"""
            },
            cognitons=WILL,
            facilities=("Hut",),
        ),
    )
    found = followed(model, 7, "x", "y")
    assert found[0] == found[1] == (2.0, 3.0)
    assert found[2] != found[3] == found[2] or found[2] == found[3]
    assert found[-1] == (2.0, 3.0)


def test_where_nothing_is_ever_built_all_ground_is_free(tmp_path):
    plan = """
A_SetTargetToClosestEmptyPatch
A_GoToTarget
L_IsAnyFacilityHere
  A_AddItem,o(Objet Corn),n(Integer 1)
  A_AddItem,o(Objet Corn),n(Integer 5)
"""
    model = imported(tmp_path, files_of(plans={"Work": plan}, cognitons=WILL, objects=("Corn",)))
    assert followed(model, 3, "corn", "x", "y") == [(0, 2, 3), (0, 2, 3), (5, 2, 3)]
