"""Who decides about a robot's role after a delivery, where its learned mind does not.

In a programmed robot it is a cogniton scheme, whose plans are the two roles: the last payoff says
whether there is plenty of what the robot fetches, and reinforces its calling. The others are what
both are compared with: robots of fixed roles, of random ones, and greedy ones.
"""

from socialmind.economy import towards_neutral

LEARNED, FIXED, RANDOM, GREEDY = 0, 1, 2, 3
"""What decides in the robots that are not programmed."""
AS_IT_SHOULD_BE = 0.5  # the payoff where neither kind is scarce
PERCENT = 100.0  # in which the scheme counts what deliveries are worth
CALLING_FACTOR = 0.8  # what a delivery leaves of a calling before it is reinforced
CALLING_BOUND = 100.0
FIRST_CALLING = 25.0  # of a robot that takes up a role: half of what it comes to


# Who decides --------------------------------------------------------------------------------------


def appoint(robot, model):
    """Let the scheme decide in a robot, if that brings its share nearest to what it should be."""
    having = robot.id
    if having >= model.foragers:
        having = 0
        for other in model.robots:
            if other.programmed:
                having += 1
    robot.programmed = is_due(model.programmed, having, len(model.robots))


def is_due(share, having, of):
    """Say whether one more than there are brings their share of so many nearest to a share."""
    return having + 0.5 < share * of


def is_learned(robot, model):
    """Say whether the learned mind decides in a robot."""
    return model.unlearned == LEARNED and not robot.programmed


def fixed_in_b(robot, model):
    """Say whether a robot of a fixed role fetches B: as wanted, of all the robots of its sort."""
    of = 0
    having = 0
    if robot.id < model.foragers:
        for founder in range(model.foragers):
            if not is_due(model.programmed, founder, model.foragers):
                of += 1
                if founder < robot.id:
                    having += 1
    else:
        for other in model.robots:
            if not other.programmed:
                of += 1
                if other.is_b and other.id != robot.id:
                    having += 1
    return is_due(model.wanted_b, having, of)


# How they decide ----------------------------------------------------------------------------------


def decide(robot, model, rng):
    """Let a robot decide that has just delivered, unless its learned mind does."""
    if robot.programmed:
        follow_scheme(robot, model, rng)
    elif model.unlearned == RANDOM:
        change_role(robot, rng.random() < model.wanted_b)
    elif model.unlearned == GREEDY and robot.payoff < AS_IT_SHOULD_BE:
        change_role(robot, not robot.is_b)


def change_role(robot, to_b):
    """Tell the robot's skills what its role is."""
    robot.hierarchy.set_variable("ROLE", 1.0 if to_b else 0.0)


def follow_scheme(robot, model, rng):
    """Let a delivery reinforce the plan that led to it, see what it says, and choose."""
    if robot.is_b:
        reinforce(robot, "CollectB", "CallingB")
        perceive(robot, model, "PlentyOfB")
    else:
        reinforce(robot, "CollectA", "CallingA")
        perceive(robot, model, "PlentyOfA")
    robot.plan = robot.mind.choose_next_plan()
    robot.run_plan(model, rng)


def reinforce(robot, plan, calling):
    """Let a calling fade, and confirm it by what the plan was worth."""
    value = robot.mind.get_cogniton_value(calling)
    rested = towards_neutral(value, CALLING_FACTOR, 0.0, CALLING_BOUND)
    robot.mind.set_cogniton_value(calling, rested)
    robot.mind.feed_back_from_plan(plan, PERCENT * min(max(robot.payoff, 0.0), 1.0))


def perceive(robot, model, plenty):
    """See by how much an object was worth less than it should be, if by enough to matter."""
    lack = PERCENT * (AS_IT_SHOULD_BE - max(robot.payoff, 0.0))
    if lack > model.tolerance:
        robot.mind.activate_cogniton(plenty)
        robot.mind.set_cogniton_value(plenty, lack)
    else:
        robot.mind.deactivate_cogniton(plenty)


# Plans --------------------------------------------------------------------------------------------


def collect_a(robot):
    """Fetch A from now on, or go on with it."""
    if robot.is_b:
        leave(robot, "CallingB", "PlentyOfB")
        take_up(robot, "CallingA")
    change_role(robot, False)


def collect_b(robot):
    """Fetch B from now on, or go on with it."""
    if not robot.is_b:
        leave(robot, "CallingA", "PlentyOfA")
        take_up(robot, "CallingB")
    change_role(robot, True)


def leave(robot, calling, plenty):
    """Give up a calling, and what was known of it."""
    robot.mind.deactivate_cogniton(calling)
    robot.mind.deactivate_cogniton(plenty)


def take_up(robot, calling):
    """Begin with a calling."""
    robot.mind.activate_cogniton(calling)
    robot.mind.set_cogniton_value(calling, FIRST_CALLING)


def begin_plan(robot):
    """Give a programmed robot the plan of the role that it begins with."""
    if robot.is_b:
        robot.plan = "CollectB"
        take_up(robot, "CallingB")
    else:
        robot.plan = "CollectA"
        take_up(robot, "CallingA")
