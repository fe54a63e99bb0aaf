"""Devices of a modeller's own, one of each kind, that keep to the same contract as ours."""

from socialmind.worlds.plane.devices.device import Act, Interruption, Reward, Sense


def crowd(members, own, robot, model, rng, memory, enough=4.0):
    """A sensor: how many are near, of those that there may be; it remembers the most."""
    count = 0
    for one in members:
        if abs(one.x - robot.x) < 10 and not (own and one.id == robot.id):
            count += 1
    if rng.random() < 0.1 and model.tick > 3:
        count += 1
    memory[1] = float(count)
    memory[0] = max(memory)
    return memory[0] / enough


def brake(robot, command, before, reading, strength):
    """An actuator: holds the robot back, more so if something is near."""
    if command > before:
        robot.push_x -= strength * command * robot.vx * (1.0 - reading)
        robot.push_y -= strength * command * robot.vy * (1.0 - reading)


def calm(robot, readings, memory, restarted, held, target):
    """A reward: for not changing speed, while something is carried."""
    before = memory[0]
    memory[0] = abs(robot.vx) + abs(robot.vy)
    if restarted or not held:
        return 0.0
    return max(readings) - abs(memory[0] - before) + 0.001 * target.x


def too_close(found, distance, bearing, slot, kind, limit=3.0):
    """An interruption: something ahead is nearer than it may be."""
    return found and distance < limit + 0.1 * slot + kind and abs(bearing) < 1


OWN = {
    "own sense": Sense(crowd, of="robots", memory=2),
    "own act": Act(brake, sensor="S1", settings={"strength": 2}),
    "own reward": Reward(calm, of="objects", free=False, sensors=("S1", "S2"), memory=1),
    "own interruption": Interruption(too_close, of="objects", at=(1.0, 0.0), angle=0.2),
}
