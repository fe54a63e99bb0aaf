"""A turtle between a red, a blue and a green patch: the CogLogo tutorial (thesis, A.7)."""

from socialmind import Agent, Model, Patch, Population, Torus, each, once, parameter

RED, BLUE, GREEN = 1, 2, 3


class Ground(Patch):
    """A patch and its colour; 0 is none."""

    colour: int = 0


def paint(model):
    """Colour three patches and their neighbours."""
    for dx in range(-1, 2):
        for dy in range(-1, 2):
            model.world.patch(9 + dx, 9 + dy).colour = RED
            model.world.patch(-9 + dx, 9 + dy).colour = BLUE
            model.world.patch(dx, -9 + dy).colour = GREEN


def live(turtle, model, rng):
    """Look at the ground, choose a plan and follow it."""
    colour = model.world.patch(turtle.x, turtle.y).colour
    if colour in (RED, BLUE):
        turtle.mind.set_cogniton_value("wantRed", colour == BLUE)
        turtle.mind.set_cogniton_value("wantBlue", colour == RED)
    elif colour == GREEN:
        turtle.mind.set_cogniton_value("wantGreen", 0)
        model.visits += 1
    turtle.plan = turtle.mind.choose_next_plan()
    turtle.run_plan(model, rng)


def go_to_red(turtle, model):
    """Step towards the red patch, and grow fonder of the green one."""
    model.world.walk_to(turtle, 9, 9, 1)
    turtle.mind.feed_back_from_plan("goto-red", model.reward)


def go_to_blue(turtle, model):
    """Step towards the blue patch, and grow fonder of the green one."""
    model.world.walk_to(turtle, -9, 9, 1)
    turtle.mind.feed_back_from_plan("goto-blue", model.reward)


def go_to_green(turtle, model):
    """Step towards the green patch."""
    model.world.walk_to(turtle, 0, -9, 1)


class Tutorial(Model):
    """A turtle between a red, a blue and a green patch (thesis, A.7)."""

    ticks = 2000
    n_turtles: int = parameter(1, unit="turtles", low=1, doc="turtles, all of them at the middle")
    reward: float = parameter(1.1, unit="feed-back", low=0.0, doc="what a step is worth")
    visits: int = 0
    world = Torus(33, Ground)
    turtles = Population(
        Agent,
        "n_turtles",
        mind="scheme.yaml",
        plans={"goto-red": go_to_red, "goto-blue": go_to_blue, "goto-green": go_to_green},
    )
    setup = (once(paint),)
    schedule = (each(turtles, live),)
