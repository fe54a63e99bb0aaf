"""A turtle between a red, a blue and a green patch: the CogLogo tutorial (thesis, A.7)."""

from socialmind import Agent, Model, Patch, Population, Torus, each, once, parameter

NOTHING, RED, BLUE, GREEN = 0, 1, 2, 3


class Turtle(Agent):
    trips: int = 0  # times that it came to green


class Ground(Patch):
    colour: int = NOTHING


def paint(model):
    paint_around(model, model.red_x, model.red_y, RED)
    paint_around(model, model.blue_x, model.blue_y, BLUE)
    paint_around(model, model.green_x, model.green_y, GREEN)


def paint_around(model, x, y, colour):
    for dx in range(-1, 2):
        for dy in range(-1, 2):
            model.world.patch(x + dx, y + dy).colour = colour


def arrive(turtle, model, rng):
    turtle.x = rng.uniform(-16.5, 16.5)
    turtle.y = rng.uniform(-16.5, 16.5)


def live(turtle, model, rng):
    colour = model.world.patch(turtle.x, turtle.y).colour
    if colour == RED:
        turtle.mind.set_cogniton_value("wantRed", 0)
        turtle.mind.set_cogniton_value("wantBlue", 1)
    elif colour == BLUE:
        turtle.mind.set_cogniton_value("wantRed", 1)
        turtle.mind.set_cogniton_value("wantBlue", 0)
    elif colour == GREEN:
        turtle.mind.set_cogniton_value("wantGreen", 0)
        turtle.trips += 1
    turtle.plan = turtle.mind.choose_next_plan()
    turtle.run_plan(model, rng)


def go_to_red(turtle, model):
    model.world.face(turtle, model.red_x, model.red_y)
    model.world.forward(turtle, 1)
    turtle.mind.feed_back_from_plan("goto-red", model.reward)


def go_to_blue(turtle, model):
    model.world.face(turtle, model.blue_x, model.blue_y)
    model.world.forward(turtle, 1)
    turtle.mind.feed_back_from_plan("goto-blue", model.reward)


def go_to_green(turtle, model):
    model.world.face(turtle, model.green_x, model.green_y)
    model.world.forward(turtle, 1)


class Tutorial(Model):
    """A turtle between a red, a blue and a green patch (thesis, A.7)."""

    ticks = 2000
    n_turtles: int = parameter(1, unit="turtles", low=0, doc="turtles at the start")
    reward: float = parameter(1.1, unit="feed-back", low=0.0, doc="what a step is worth")
    red_x: int = 9
    red_y: int = 9
    blue_x: int = -9
    blue_y: int = 9
    green_x: int = 0
    green_y: int = -9
    world = Torus(33, Ground)
    turtles = Population(
        Turtle,
        "n_turtles",
        mind="scheme.yaml",
        plans={"goto-red": go_to_red, "goto-blue": go_to_blue, "goto-green": go_to_green},
    )
    setup = (once(paint), each(turtles, arrive))
    schedule = (each(turtles, live),)
