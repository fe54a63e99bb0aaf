"""Who decides about a robot's role after a delivery, where its learned mind does not.

In a programmed robot it is a cogniton scheme, whose plans are the two roles: the last payoff says
whether there is plenty of what the robot fetches, and reinforces its calling. The others are what
both are compared with: robots of fixed roles, of random ones, and greedy ones.
"""

LEARNED, FIXED, RANDOM, GREEDY = 0, 1, 2, 3
"""What decides in the robots that are not programmed."""
AS_IT_SHOULD_BE = 0.5  # the payoff where neither kind is scarce
PERCENT = 100.0  # what the scheme counts payoffs in
WORTH_A_THOUGHT = 3.0  # per cent that a payoff may lack without anything coming of it
FIRST_CALLING = 20.0  # of a robot that takes up a role
WEAKEST, STRONGEST = 10.0, 30.0  # callings


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
    """Perceive what the last object was worth, be confirmed in the calling by it, and choose."""
    if robot.is_b:
        perceive(robot, "CollectB", "CallingB", "PlentyOfB")
    else:
        perceive(robot, "CollectA", "CallingA", "PlentyOfA")
    robot.plan = robot.mind.choose_next_plan()
    robot.run_plan(model, rng)


def perceive(robot, plan, calling, plenty):
    """Let a payoff act on the calling that it was for, and see whether there is plenty."""
    worth = PERCENT * (robot.payoff - AS_IT_SHOULD_BE)
    robot.mind.feed_back_from_plan(plan, worth)
    value = robot.mind.get_cogniton_value(calling)
    robot.mind.set_cogniton_value(calling, min(max(value, WEAKEST), STRONGEST))
    if worth < -WORTH_A_THOUGHT:
        robot.mind.activate_cogniton(plenty)
        robot.mind.set_cogniton_value(plenty, -worth)
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
