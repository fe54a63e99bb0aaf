"""Vehicles with two eyes and two wheels that reach lights or avoid them (thesis, figure 2.3).

A vehicle has one base skill, its wiring: the light in each eye is the speed of a wheel. Wires that
cross turn it to a light and wires that do not turn it away, though nothing in it knows what a light
is or where.
"""

import math

import numpy as np

from socialmind import Agent, Model, Population, Torus, each, parameter

EYE_ANGLE = 45.0  # degrees from straight ahead to where each eye looks
KINDS = ("fear", "aggression", "love", "exploration")
"""What Braitenberg calls the wirings: straight or crossed and, from the third, inhibiting."""


class Light(Agent):
    """A source of light."""


class Vehicle(Agent):
    """A vehicle: how it is wired, what it sees and does, and the light that is nearest to it."""

    crossed: bool = False
    inhibiting: bool = False
    left_eye: float = 0.0
    right_eye: float = 0.0
    left_wheel: float = 0.0
    right_wheel: float = 0.0
    light_x: float = 0.0
    light_y: float = 0.0


def arrive(vehicle, model, rng):
    """Put a vehicle on a random place, and choose its wiring."""
    scatter(vehicle, model, rng)
    vehicle.heading = rng.uniform(0, 360)
    vehicle.inhibiting = rng.random() < model.share_inhibiting
    # Wires that slow wheels down turn a vehicle the other way.
    vehicle.crossed = (rng.random() >= model.share_fleeing) != vehicle.inhibiting
    find_light(vehicle, model)


def scatter(agent, model, rng):
    """Put an agent on a random place."""
    agent.x = rng.uniform(model.world.low - 0.5, model.world.high + 0.5)
    agent.y = rng.uniform(model.world.low - 0.5, model.world.high + 0.5)


def live(vehicle, model):
    """Look, let the skill command the wheels, and roll."""
    look(vehicle, model)
    vehicle.hierarchy.set_sensor("LEFT", vehicle.left_eye)
    vehicle.hierarchy.set_sensor("RIGHT", vehicle.right_eye)
    vehicle.hierarchy.set_sensor("CROSSED", vehicle.crossed)
    vehicle.hierarchy.set_sensor("INHIBITING", vehicle.inhibiting)
    vehicle.hierarchy.evaluate()
    vehicle.left_wheel = vehicle.hierarchy.actuator("WHEEL_LEFT")
    vehicle.right_wheel = vehicle.hierarchy.actuator("WHEEL_RIGHT")
    # The faster wheel is on the outside of the turn.
    model.world.right(vehicle, model.largest_turn * (vehicle.left_wheel - vehicle.right_wheel))
    speed = model.full_speed * (vehicle.left_wheel + vehicle.right_wheel) / 2
    model.world.forward(vehicle, speed)
    find_light(vehicle, model)


def look(vehicle, model):
    """Add up the light that falls into each eye."""
    left = 0.0
    right = 0.0
    for light in model.lights:
        away = model.world.distance(vehicle, light.x, light.y) / model.reach
        brightness = 1 / (1 + away * away)
        bearing = model.world.towards(vehicle, light.x, light.y) - vehicle.heading
        left += brightness * facing(bearing + EYE_ANGLE)
        right += brightness * facing(bearing - EYE_ANGLE)
    vehicle.left_eye = min(left, 1.0)
    vehicle.right_eye = min(right, 1.0)


def facing(angle):
    """Return the share of light that an eye catches which looks past the source by an angle."""
    return max(0.0, min(1.0, (1 + math.cos(math.radians(angle))) / 2))


def find_light(vehicle, model):
    """Note which light is the nearest."""
    least = math.inf
    for light in model.lights:
        away = model.world.distance(vehicle, light.x, light.y)
        if away < least:
            least = away
            vehicle.light_x = light.x
            vehicle.light_y = light.y


class Braitenberg(Model):
    """Vehicles that reach or avoid lights by their wiring alone (thesis, figure 2.3)."""

    ticks = 500

    n_vehicles: int = parameter(40, unit="vehicles", low=1, doc="vehicles")
    n_lights: int = parameter(3, unit="lights", low=1, doc="lights, on random places")
    share_fleeing: float = parameter(
        0.5, unit="share", low=0.0, high=1.0, doc="chance that a wiring turns away from light"
    )
    share_inhibiting: float = parameter(
        0.0, unit="share", low=0.0, high=1.0, doc="chance that light slows the wheels"
    )
    reach: float = parameter(
        6.0, unit="patches", low=0.1, doc="distance at which a light is half as bright"
    )
    full_speed: float = parameter(
        0.25, unit="patches a tick", low=0.0, doc="speed with both wheels at full speed"
    )
    largest_turn: float = parameter(
        30.0, unit="degrees a tick", low=0.0, high=180.0, doc="turn with one wheel at full speed"
    )
    world_size: int = parameter(33, unit="patches", low=3, high=20_000, doc="side of the world")

    world = Torus("world_size")
    vehicles = Population(Vehicle, "n_vehicles", hierarchy="mind")
    lights = Population(Light, "n_lights")

    setup = (each(lights, scatter), each(vehicles, arrive))
    schedule = (each(vehicles, live),)

    def series(self):
        """Return how far from the nearest light those are that seek it and those that flee it."""
        seekers = self.seekers()
        away = self.distances()
        return {
            "seekers": int(seekers.sum()),
            "avoiders": int((~seekers).sum()),
            "seekers_distance": mean(away[seekers]),
            "avoiders_distance": mean(away[~seekers]),
            "seekers_speed": mean(self.speeds()[seekers]),
            "avoiders_speed": mean(self.speeds()[~seekers]),
        }

    def agents(self):
        """Return each vehicle's wiring, place, eyes and wheels."""
        vehicles = self.vehicles
        kind = 2 * vehicles.inhibiting + vehicles.crossed
        return {
            "agent": vehicles.id,
            "kind": [KINDS[one] for one in kind],
            "x": vehicles.x,
            "y": vehicles.y,
            "heading": vehicles.heading,
            "left_eye": vehicles.left_eye,
            "right_eye": vehicles.right_eye,
            "left_wheel": vehicles.left_wheel,
            "right_wheel": vehicles.right_wheel,
            "light_x": vehicles.light_x,
            "light_y": vehicles.light_y,
            "distance": self.distances(),
        }

    def seekers(self):
        """Return for each vehicle whether its wiring turns it to light."""
        return self.vehicles.crossed != self.vehicles.inhibiting

    def distances(self):
        """Return how far each vehicle is from the nearest light."""
        dx = np.abs(self.vehicles.x - self.vehicles.light_x)
        dy = np.abs(self.vehicles.y - self.vehicles.light_y)
        size = self.world_size
        return np.hypot(np.minimum(dx, size - dx), np.minimum(dy, size - dy))

    def speeds(self):
        """Return how fast each vehicle goes, in patches a tick."""
        return self.full_speed * (self.vehicles.left_wheel + self.vehicles.right_wheel) / 2


def mean(values):
    """Return the mean as a plain number, NaN of nothing."""
    return float(values.mean()) if len(values) else math.nan
