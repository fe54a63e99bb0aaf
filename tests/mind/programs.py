"""Functions of the modeller's own, that minds of the tests name and that are saved with them."""

import math

GAIN = 0.75


def bent(value):
    return math.sin(GAIN * value)


def steer(left, right):
    return bent(right), GAIN * bent(left)


def mean(inputs):
    total = 0.0
    for value in inputs:
        total += value
    return total / len(inputs)


def leak(command, value, memory):
    return value + 0.25 * (command - value), memory + 1.0
