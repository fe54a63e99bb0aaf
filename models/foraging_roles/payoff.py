"""What an object that is brought home is worth to the group, by the farmers' market and decay."""

from socialmind.economy import demand_perception, proportional_decay

from .roles import choose_start

COUNTED = 3.0  # objects delivered a robot that have been counted before the start
PAYOFF = 0.15  # how much of the payoff sensor's range a perceived demand of 1 takes


def open_market(market, model, rng):
    """Let the group's counts begin at the wanted ratio, as if it had worked before."""
    model.wanted = model.wanted_b
    counted = COUNTED * len(model.robots)
    market.staple = counted * model.wanted
    market.ware = counted * (1 - model.wanted)
    choose_start(model, rng)


def pay(robot, model):
    """Count an object that was delivered, and tell the robot what it is worth."""
    for market in model.markets:
        if robot.load == 1:
            market.ware += 1
        else:
            market.staple += 1
        market.perception = scarcity_of_a(market.staple, market.ware, model.wanted)
        robot.payoff = worth(market.perception if robot.load == 1 else -market.perception)
    robot.paid = True
    robot.earned += 1


def scarcity_of_a(count_b, count_a, wanted):
    """Return how much scarcer A is than it should be; B is the market's staple, A its ware.

    The price of an A is the wanted ratio; as many A as are wanted of all objects are plenty.
    """
    price = wanted / (1 - wanted)
    return demand_perception(count_b, count_a, price, (count_b + count_a) * (1 - wanted))


def worth(scarcity):
    """Return the payoff of an object, more than 0.5 where its kind is scarce."""
    return 0.5 + PAYOFF * scarcity


def forget(market, model):
    """Let the counts decay."""
    market.staple = proportional_decay(market.staple, model.decay)
    market.ware = proportional_decay(market.ware, model.decay)
