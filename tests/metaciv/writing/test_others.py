"""What agents of imported models do to each other, worked out by hand."""

from .folders import files_of, imported

TICKS = "L_CompareAttribute,a(Attribute age),c(Comparator ==),n(Double {}.0)"
AGE = "A_ChangeAttribute,a(Attribute age),n(Integer 1)"
WILL = {"Will": (True, "Work", {"Work": 1})}
ROLE = "Culturon : one,Mark\nAutoJoin : false,null\n"


def society_of(tmp_path, plan, agents=2, birth=None, self_plan=AGE, **more):
    """A society of a few who do what a plan says, in the order of birth; its first tick is run."""
    plans = {"Work": plan, "Age": self_plan}
    kinds = {"Age": "self"}
    if birth:
        plans["Born"], kinds["Born"] = birth, "birth"
    files = files_of(
        plans=plans,
        kinds=kinds,
        cognitons=more.pop("cognitons", WILL),
        attributes={"age": 0, "tag": 0, "life": 5},
        agents=agents,
        **more,
    )
    model = imported(tmp_path, files)
    society = model(seed=1, compiled=False)
    society.advance(2)
    return society


def test_requests_are_heard_accepted_and_traded_upon(tmp_path):
    society = society_of(
        tmp_path,
        """
L_OwnObject,o(Objet Wheat)
  A_BroadcastMessage_Commerce_SiObjet,o(Objet Wheat),n(Integer 3)
  A_DoNothing
L_ARequeteCommerce
  L_OwnObject,o(Objet Wheat)
    A_DoNothing
    A_AccepterCommerce
L_GotTargetInteraction
  I_Commercer_Repondu,objectToGive(Objet Wheat),nObjectToGive(Integer 2),MORE
  A_DoNothing
""".replace("MORE", "objectToTake(Objet Tool),nObjectToTake(Integer 1)"),
        objects=("Wheat", "Tool"),
    )
    seller, buyer = society.humans
    seller.wheat, buyer.tool = 5, 3
    society.advance(3)
    assert (seller.wheat, seller.tool, buyer.wheat, buyer.tool) == (3, 1, 2, 2)
    assert seller.target == -1


def test_who_hires_leads_who_accepts(tmp_path):
    society = society_of(
        tmp_path,
        f"""
{TICKS.format(1)}
  A_BroadcastMessage_Embauche,n(Integer 5)
L_ARequeteEmbauche
  A_SetCibleInteractionInitiateur
L_GotTargetInteraction
  I_RejoindreGroupe
L_AUnChef
  A_SetEnMissionTrue
L_ADesEmployes
  A_PartagerRessourceEmployes,o(Objet Wheat),n(Integer 2)
L_AEmployeeEnMission
  I_ModifierCognitonsEmployee,c(Cogniton Joy),n(Double 2.0)
I_GiveItemToChef,o(Objet Tool),n(Integer 1)
I_TakeItemsFromChef,o(Objet Wheat),n(Integer 1)
""",
        objects=("Wheat", "Tool"),
        cognitons={**WILL, "Joy": (False, "", {})},
    )
    chief, worker = society.humans
    worker.age = -5.0  # asks for nothing itself
    chief.wheat, worker.tool = 9, 2
    society.advance(1)
    worker.target = chief.id
    society.advance(1)
    worker.target = chief.id
    society.advance(1)
    assert worker.chief == chief.id and chief.chief == -1
    society.advance(2)
    assert (chief.wheat, worker.wheat) == (7, 2)
    society.advance(1)
    assert worker.mind.get_cogniton_value("Joy") == 2.0
    society.advance(2)
    assert (chief.tool, worker.tool) == (1, 1)
    assert (chief.wheat, worker.wheat) == (6, 3)


def test_attacks_hurt_are_noticed_and_have_a_culprit(tmp_path):
    society = society_of(
        tmp_path,
        f"""
{TICKS.format(1)}
  A_GetCibleInteraction_Tag,a(Attribute tag)
L_GotTargetInteraction
  I_Attaquer,a(Attribute life)
L_IsAttacked
  A_AddItem,o(Objet Wound),n(Integer 1)
L_AttackerGotTag,a(Attribute life)
  A_AddItem,o(Objet Grudge),n(Integer 1)
""",
        objects=("Wound", "Grudge"),
    )
    attacker, victim = society.humans
    victim.tag = 1.0
    victim.age = -9.0
    society.advance(4)
    assert attacker.target == victim.id
    assert (victim.life, victim.wound, victim.grudge) == (4.0, 1, 1)
    assert (attacker.life, attacker.wound) == (5.0, 0)


def test_strangers_are_killed_and_friends_are_spared(tmp_path):
    tagged = "L_CompareAttribute,a(Attribute tag),c(Comparator {}),n(Double 1.0)"
    society = society_of(
        tmp_path,
        f"""
{tagged.format(">=")}
  A_CreateGroup,g(GroupAndRole Clan:one)
{tagged.format("==")}
  A_HireForRole,g(GroupAndRole Clan:one)
{tagged.format("==")}
  A_killOtherAgentOnPatchThatIsNotInMyGroup
A_DoNothing
""",
        groups={"Clan": ROLE},
        cognitons={**WILL, "Mark": (False, "", {})},
        agents=3,
    )
    founder, friend, stranger = society.humans
    founder.tag, stranger.tag = 1.0, 2.0
    stranger.x = 0.0
    society.advance(2)
    assert friend.mind.get_group_id("Clan") == founder.mind.get_group_id("Clan") >= 0
    stranger.x = founder.x
    society.advance(2)
    assert [one.id for one in society.humans] == [founder.id, friend.id]


def test_a_leader_is_elected_by_half_of_those_around(tmp_path):
    society = society_of(
        tmp_path,
        """
A_CreateElectedGroup,(GroupAndRole Clan:chief),(GroupAndRole Clan:one),(Cogniton Trust),(Integer 2)
L_CompareGroupAttributeToPopulation,a(Attribute life),c(Comparator >)
  A_FollowRoleInGroup,g(GroupAndRole Clan:chief)
  A_Move,NORTH
""",
        groups={"Clan": "Culturon : chief,Mark\nCulturon : one,Mark\nAutoJoin : false,null\n"},
        cognitons={**WILL, "Mark": (False, "", {}), "Trust": (True, "", {})},
        agents=3,
    )
    for human in society.humans:
        human.mind.set_cogniton_value("Trust", 10.0)  # they vote for certain
    society.advance(1)
    minds = [one.mind for one in society.humans]
    assert len({one.get_group_id("Clan") for one in minds}) == 1
    assert sum(one.get_group_role_id("Clan", "chief") >= 0 for one in minds) == 1
    society.advance(1)
    assert {one.y for one in society.humans} == {3.0}  # where the chief is already


def test_partners_wait_for_each_other_and_swap(tmp_path):
    give = (
        "A_Trade,turns(Integer 3),itemToGive(Objet {}),nItemToGive(Integer 2),itemToTake(Objet {}),"
        "nItemToTake(Integer 1),myTag(String {}),compatibleTag(String {})"
    )
    society = society_of(
        tmp_path,
        f"""
L_CompareAttribute,a(Attribute tag),c(Comparator ==),n(Double 1.0)
  {give.format("Corn", "Wine", "corn", "wine")}
    A_AddItem,o(Objet Joy),n(Integer 1)
    A_AddItem,o(Objet Grief),n(Integer 1)
  {give.format("Wine", "Corn", "wine", "corn")}
    A_AddItem,o(Objet Joy),n(Integer 1)
    A_AddItem,o(Objet Grief),n(Integer 1)
A_Move,NORTH
""".replace("nItemToGive(Integer 2),itemToTake(Objet Corn),nItemToTake(Integer 1)",
            "nItemToGive(Integer 1),itemToTake(Objet Corn),nItemToTake(Integer 2)"),
        objects=("Corn", "Wine", "Joy", "Grief"),
    )  # fmt: skip
    one, other = society.humans
    one.tag, one.corn, other.wine = 1.0, 5, 4
    society.advance(2)
    assert (one.corn, one.wine, other.corn, other.wine) == (3, 1, 2, 3)
    society.advance(2)
    assert one.joy + other.joy == 1 and one.grief + other.grief == 0
    society.advance(8)  # they have parted, and wait in vain
    assert one.grief + other.grief >= 1 or one.joy + other.joy == 2
