"""A model as MetaCiv's public ones are built: 19 plans, a village of three roles, fields, barns.

Gatherers found villages, build granaries, turn farmers and artisans, have children and grow old.
"""

import random

import pytest

from .folders import files_of, imported

PLANS = {
    "Grandir": """
A_ChangeAttribute,a(Attribute age),n(Integer 1)
L_RandomPercent,n(Double 30.0)
  A_ChangeAttribute,a(Attribute faim),n(Integer 1)
L_CompareAttribute,a(Attribute age),c(Comparator >),n(Double 900.0 Constant age_max)
  L_RandomPercent,n(Double 2.0)
    A_Die
""",
    "Naitre": """
A_AddItem,o(Objet Graine),n(Integer 2)
A_ChangeAttributeDouble,a(Attribute force),n(Double 0.5)
""",
    "Errer": """
L_Repeat,n(Integer 3)
  A_AvanceAleatoirement
L_ComparePhero,p(Pheromone Baies),c(Comparator >=),n(Double 1.0)
  A_Transform,p(Pheromone Baies),o(Objet Baie)
""",
    "Cueillir": """
A_SmellAndMove,p(Pheromone Baies)
L_ComparePhero,p(Pheromone Baies),c(Comparator >=),n(Double 1.0)
  A_Transform,p(Pheromone Baies),o(Objet Baie)
""",
    "Couper du bois": """
A_SearchForRessources,p(Pheromone Bois)
L_ComparePhero,p(Pheromone Bois),c(Comparator >=),n(Double 1.0)
  A_Transformer,p(Pheromone Bois),o(Objet Bois)
  A_ChangeCognitonWeight,c(Cogniton Curieux),n(Double 0.1000000000000188)
""",
    "Manger": """
L_CompareNombreObjets,o(Objet Baie),c(Comparator >=),n(Double 1.0)
  L_Instant
    A_UseObject,o(Objet Baie),n(Integer 1)
    A_ChangeCognitonWeightInteger,c(Cogniton Content),n(Double 1.0)
  L_OwnObject,o(Objet Pain)
    A_UseObject,o(Objet Pain),n(Integer 1)
    A_ChangeCognitonWeightInteger,c(Cogniton Content),n(Double -1.0)
""",
    "Fonder un village": """
L_IsInGroup,g(Group Village)
  A_DoNothing
  L_CompareNObject,o(Objet Bois),c(Comparator >=),n(Integer 1)
    A_CreateGroup,g(GroupAndRole Village:Cueilleur)
    A_AvanceAleatoirement
""",
    "Construire le grenier": """
L_IsFacilityInGroup,a(Amenagement Grenier),g(Group Village)
  A_DoNothing
  L_IsAnyFacilityHere
    A_AvanceAleatoirement
    A_CreateGroupFacility,a(Amenagement Grenier),g(Group Village)
""",
    "Deposer": """
A_GoToClosestGroupFacility,a(Amenagement Grenier),g(Group Village)
L_IsGroupFacilityHere,a(Amenagement Grenier),g(Group Village)
  L_Instant
    A_DepositObjectInFacilityHere,o(Objet Baie),n(Integer 3),a(Amenagement Grenier)
    A_DepositObjectInFacilityHere,o(Objet Ble),n(Integer 3),a(Amenagement Grenier)
""",
    "Retirer": """
A_GoToClosestGroupFacility,a(Amenagement Grenier),g(Group Village)
A_WithdrawObjectFromFacilityHere,o(Objet Baie),n(Integer 1),a(Amenagement Grenier)
A_WithdrawObjectFromFacilityHere,o(Objet Ble),n(Integer 2),a(Amenagement Grenier)
""",
    "Defricher": """
L_OwnPrivateFacility,a(Amenagement Champ)
  A_GoToPrivateFacility,a(Amenagement Champ)
  L_IsAnyFacilityHere
    A_AvanceAleatoirement
    A_CreatePrivateFacility,a(Amenagement Champ)
""",
    "Cultiver": """
L_IsPrivateFacilityHere,a(Amenagement Champ)
  L_MultipleActions
    A_DropItem,o(Objet Graine),n(Integer 1)
    A_AddItem,o(Objet Ble),n(Integer 2 Constant rendement)
  A_GoToPrivateFacility,a(Amenagement Champ)
""",
    "Fabriquer un outil": """
A_CreateObject,o(Objet Houe)
A_ReplaceCognitonWeight,c(Cogniton Curieux),n(Double 1.0)
""",
    "Faire du pain": """
L_CompareNObject,o(Objet Ble),c(Comparator >=),n(Integer 2)
  A_CreateObject,o(Objet Pain)
""",
    "Enfanter": """
L_CompareCogniton,c(Cogniton Content),c(Comparator >),n(Double 5.0)
  L_Instant
    A_BirthGroupAndRole,g(GroupAndRole Village:Cueilleur)
    A_ReplaceCognitonWeight,c(Cogniton Content),n(Double 1.0)
""",
    "Devenir agriculteur": """
L_CompareRoleMembers,g(GroupAndRole Village:Cueilleur),c(Comparator >),n(Double 2.0)
  A_ChangeRoleForAnother,g(GroupAndRole Village:Agriculteur)
""",
    "Devenir artisan": """
L_IsInThatGroupInThatRole,g(GroupAndRole Village:Agriculteur)
  L_RandomPercent,n(Double 20.0)
    A_ChangeRoleForAnother,g(GroupAndRole Village:Artisan)
    A_AskRandomMemberToChangeRoleForAnother,g(GroupAndRole Village:Agriculteur)
""",
    "Embaucher": """
A_HireForRole,g(GroupAndRole Village:Cueilleur)
L_EveryXTick,n(Integer 2)
  A_EmitCogniton,c(Cogniton Curieux),n(Double 0.2)
""",
    "Se reposer": """
A_DoNothing
A_DoNothing
L_IsOnTerrain,t(Terrain Foret)
  A_DoNothing
  A_Move,NORTH
""",
}
LINKS = {
    "Vivant": {"Errer": 2, "Cueillir": 3, "Manger": 0},
    "Seul": {"Couper du bois": 1, "Fonder un village": 2, "Se reposer": 1},
    "Cueille": {"Deposer": 3, "Construire le grenier": 2, "Devenir agriculteur": 1, "Embaucher": 1},
    "Cultive": {"Defricher": 2, "Cultiver": 4, "Deposer": 2, "Devenir artisan": 1},
    "Forge": {"Fabriquer un outil": 3, "Faire du pain": 2, "Retirer": 3},
    "Content": {"Enfanter": 1},
    "Curieux": {},
}


def lines_of(name, links):
    """The file of a cogniton that permits the plans that it moves."""
    initial = int(name in ("Vivant", "Seul", "Content", "Curieux"))
    permits = "".join(f"Permet : {one}\n" for one in links)
    return f"Initial : {initial}\n{permits}" + "".join(
        f"Influence : {one},{weight}\n" for one, weight in links.items()
    )


def village(size, agents):
    """The files of the model, on a map of that size with a forest and a lake."""
    luck = random.Random(1)
    rows = [
        ",".join(
            str(2 if (x - size // 2) ** 2 + (y - size // 3) ** 2 < 40 else int(luck.random() < 0.3))
            for x in range(size)
        )
        for y in range(size)
    ]
    cognitons = {name: lines_of(name, links) for name, links in LINKS.items()}
    cognitons["Affame"] = "Permet : Manger\nInfluence : Manger,8\nTrigger : faim,0.0,1,faim_max\n"
    cognitons["Curieux"] += "Influence : Couper du bois,2\nInfluence : Fabriquer un outil,1\n"
    effect = "NomCible : {}\nValeur : {}\nPermanence : {}\nType : {}\nActivation : {}\n"
    return files_of(
        plans=PLANS,
        cognitons=cognitons,
        kinds={"Grandir": "self", "Naitre": "birth"},
        attributes={"age": 0, "faim": 0, "force": 1},
        constants={"age_max": 900, "faim_max": 6, "rendement": 3},
        groups={
            "Village": "Culturon : Cueilleur,Cueille\nCulturon : Agriculteur,Cultive\n"
            "Culturon : Artisan,Forge\nAutoJoin : false,null\n"
        },
        objects=("Baie", "Bois", "Ble", "Pain", "Houe", "Graine"),
        recipes={"Pain": {"Ble": 2}, "Houe": {"Bois": 1}, "Grenier": {"Bois": 1}},
        facilities=("Grenier", "Champ"),
        carried_effects={"Baie": ("Nourrit",), "Pain": ("Rassasie",), "Houe": ("Aide",)},
        effects={
            "Nourrit": "Cible : attribut\n" + effect.format("faim", -4, "true", 1, 1),
            "Rassasie": "Cible : attribut\n" + effect.format("faim", 0, "true", 0, 1),
            "Aide": "Cible : attribut\n" + effect.format("force", 1, "false", 1, 0),
        },
        pheromones={"Baies": (1.2, 0.6), "Bois": (1.4, 0.4)},
        terrains={"Foret": (45, False), "Lac": (90, True)},
        rows=rows,
        width=size,
        height=size,
        agents=agents,
        place=(size // 4, size // 4),
        scattered=10,
        maker="WeightedStochastic",
    )


def test_villages_are_founded_and_build(tmp_path):
    model = imported(tmp_path, village(60, 24))
    society = model(seed=2, compiled=False)
    society.advance(60)
    seen = society.series()
    assert len(society.humans) >= 24
    assert seen["cueilleur"] > 0 and seen["greniers"] > 0
    assert all(society.world.patch(one.x, one.y).terrain != 2 for one in society.humans)
    assert seen["age"] > 40


@pytest.mark.study
def test_it_runs_a_thousand_ticks_alike_at_both_speeds(tmp_path):
    model = imported(tmp_path, village(120, 81))
    fast, slow = model(seed=1), model(seed=1, compiled=False)
    for _ in range(10):
        fast.advance(100)
        slow.advance(100)
        for name in model.populations:
            found = [[repr(one) for one in getattr(one, name)] for one in (fast, slow)]
            assert found[0] == found[1]
        assert fast.series() == slow.series()
        minds = [[one.mind.cognitons() for one in society.humans] for society in (fast, slow)]
        assert minds[0] == minds[1]
    assert fast.series()["agriculteur"] > 0
