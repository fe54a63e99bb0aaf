"""Pheromones, terrains and ways of imported models, worked out by hand."""

from .folders import files_of, followed, imported

WILL = {"Will": (True, "Work", {"Work": 1})}


def test_agents_smell_the_most_without_looking_over_the_edge(tmp_path):
    model = imported(
        tmp_path,
        files_of(
            plans={
                "Work": """
A_SmellAndMove,p(Pheromone Seed)
L_ComparePhero,p(Pheromone Seed),c(Comparator >),n(Double 5.0)
  A_Transformer,p(Pheromone Seed),o(Objet Corn)
  A_Collect,p(Pheromone Seed),n(Double 0.5)
"""
            },
            cognitons=WILL,
            objects=("Corn",),
            pheromones={"Seed": (0.0, 0.0)},
            width=5,
            height=3,
            place=(0, 1),
        ),
    )
    society = model(seed=1, compiled=False)
    society.world.patch(4, 2).seed = 7.5
    society.advance(2)
    human = society.humans[0]
    places = []
    for _ in range(8):
        society.advance(1)
        places.append((human.x, human.y))
    # Four patches to the east, though over the edge it would be one to the west.
    assert places[::2] == [(1.0, 2.0), (2.0, 2.0), (3.0, 2.0), (4.0, 2.0)]
    assert human.corn == 7
    assert [society.world.patch(x, 2).seed for x in range(1, 5)] == [0.5, 0.5, 0.5, 0.0]


def test_where_there_is_nothing_around_to_smell_agents_stay(tmp_path):
    plans = {"Work": "\nA_SmellAndMove,p(Pheromone Seed)\n"}
    files = files_of(
        plans=plans,
        cognitons=WILL,
        pheromones={"Seed": (0.0, 1.0)},
        width=1,
        height=1,
        place=(0, 0),
    )
    society = imported(tmp_path, files)(seed=1, compiled=False)
    society.advance(3)
    assert (society.humans[0].x, society.humans[0].y) == (0.0, 0.0)


def test_agents_search_and_go_round_what_is_closed_and_tell_terrains(tmp_path):
    model = imported(
        tmp_path,
        files_of(
            plans={
                "Work": """
A_SearchForRessources,p(Pheromone Seed)
L_IsOnTerrain,t(Terrain Hill)
  A_Transform,p(Pheromone Seed),o(Objet Corn)
  A_DoNothing
"""
            },
            cognitons=WILL,
            objects=("Corn",),
            pheromones={"Seed": (0.0, 0.0)},
            terrains={"Rock": (90, True), "Hill": (25, False)},
            rows=["1,1,1,1,1", "0,0,0,0,0", "0,1,1,1,1", "0,0,0,2,1", "1,1,1,1,1"],
            height=5,
            place=(3, 2),
        ),
    )
    society = model(seed=1, compiled=False)
    society.world.patch(3, 1).seed = 3.0
    society.advance(2)
    human = society.humans[0]
    places = []
    for _ in range(8):
        society.advance(1)
        places.append((human.x, human.y))
    assert places[0] == (3.0, 3.0)  # it looks round first
    assert places[-3:] == [(3.0, 1.0)] * 3
    assert all(society.world.patch(x, y).terrain != 1 for x, y in places)
    assert human.corn == 3


def test_slow_ground_takes_longer(tmp_path):
    model = imported(
        tmp_path,
        files_of(
            plans={"Work": "A_Move,EAST"},
            cognitons=WILL,
            terrains={"Hill": (45, False)},
            rows=["0,0,0,0,0"] * 3 + ["0,0,0,1,1"],
            place=(2, 4),
        ),
    )
    assert [x for (x,) in followed(model, 5, "x")] == [3.0, 3.0, 4.0, 4.0, 0.0]


def test_what_is_left_and_what_is_taken_of_a_pheromone(tmp_path):
    plan = """
A_Collect,p(Pheromone Seed),n(Double 2.5)
L_Instant
  A_Collect,p(Pheromone Seed),n(Double -3.0)
  A_DoNothing
"""
    files = files_of(plans={"Work": plan}, cognitons=WILL, pheromones={"Seed": (1.0, 0.0)})
    model = imported(tmp_path, files)
    society = model(seed=1, compiled=False)
    amounts = []
    for _ in range(4):
        society.advance(1)
        amounts.append(society.world.patch(2, 3).seed)
    assert amounts == [1.0, 1.0, 3.5, 0.5]
    written = (model.folder() / "model.py").read_text()
    assert "def take_seed(" in written and "do_nothing" not in written
