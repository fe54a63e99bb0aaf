"""Response thresholds: division of labour without anybody who divides it.

Tasks that wait give off a stimulus. Each worker takes one up with a probability that rises with
its stimulus and falls with the worker's own threshold, and by working lowers the stimulus. With
thresholds that stay as they are, a caste steps in when another is missing (Bonabeau, Theraulaz and
Deneubourg, 1998, Bulletin of Mathematical Biology 60: 753–807). With thresholds that fall by
working and rise by not working, equals become specialists (Theraulaz, Bonabeau and Deneubourg,
1998, Proceedings of the Royal Society B 265: 327–332). It is one model: without learning and
forgetting, the second is the first.
"""

import numpy as np

from socialmind import Agent, Model, Population, each, once, parameter

MOST_TASKS = 8


class Task(Agent):
    """A task: how strongly it calls."""

    stimulus: float = 0.0


class Worker(Agent):
    """A worker: what it does now, its threshold for each task, and the ticks it has given each."""

    major: bool = False
    away: bool = False
    task: int | None = None
    thresholds: list[float] = [0.0] * MOST_TASKS
    done: list[int] = [0] * MOST_TASKS


# Setup ------------------------------------------------------------------------------------------


def be_born(worker, model):
    """Get the thresholds of one's caste; the first workers are the majors."""
    worker.major = worker.id < model.n_majors
    threshold = model.majors_threshold if worker.major else model.threshold
    for task in range(model.n_tasks):
        worker.thresholds[task] = bounded(threshold, model)


# A tick -----------------------------------------------------------------------------------------


def remove_or_return(model):
    """Take the specialists of a task away, and bring them back, when it is time to."""
    if model.tick == model.remove_at:
        for worker in model.workers:
            if is_specialist(worker, model.removed_task, model):
                worker.away = True
                worker.task = None
    if model.tick == model.return_at:
        for worker in model.workers:
            worker.away = False


def work(worker, model, rng):
    """Give up what one does, or go on; with nothing to do, meet the tasks in a random order."""
    if worker.away:
        return
    if worker.task is not None:
        if rng.random() < model.giving_up:
            worker.task = None
    else:
        for task in rng.permutation(model.n_tasks):
            stimulus = model.tasks[task].stimulus
            if rng.random() < response(stimulus, worker.thresholds[task]):
                worker.task = task
                break
    if worker.task is not None:
        worker.done[worker.task] += 1


def learn(worker, model):
    """Let the threshold of the task that one does fall, and those of the others rise."""
    if worker.away and not model.forgetting_away:
        return
    for task in range(model.n_tasks):
        change = model.forgetting
        if worker.task is not None and worker.task == task:
            change = -model.learning
        worker.thresholds[task] = bounded(worker.thresholds[task] + change, model)


def call(task, model):
    """Let the stimulus of a task grow by the demand, and fall by the work of those who do it."""
    present = sum(1 for worker in model.workers if not worker.away)
    active = sum(1 for worker in model.workers if does(worker, task.id))
    task.stimulus += model.demand
    if present > 0:
        task.stimulus -= model.efficiency * active / present
    task.stimulus = max(0.0, task.stimulus)


# Thresholds -------------------------------------------------------------------------------------


def response(stimulus, threshold):
    """Return the probability of taking up a task in a tick: s² / (s² + θ²)."""
    return stimulus * stimulus / (stimulus * stimulus + threshold * threshold)


def bounded(threshold, model):
    """Return a threshold within the bounds."""
    return min(max(threshold, model.lowest_threshold), model.highest_threshold)


def does(worker, task):
    """Say whether a worker does a task."""
    return worker.task is not None and worker.task == task


def is_specialist(worker, task, model):
    """Say whether a threshold is the lowest of its worker's, and in the lower half of the range."""
    if task >= model.n_tasks:
        return False
    own = worker.thresholds[task]
    for other in range(model.n_tasks):
        if other != task and worker.thresholds[other] <= own:
            return False
    return own < (model.lowest_threshold + model.highest_threshold) / 2


class Thresholds(Model):
    """Workers that take up tasks by thresholds, fixed or learned (Bonabeau et al., 1998)."""

    ticks = 10_000

    n_workers: int = parameter(5, unit="workers", low=1, doc="workers of the colony")
    n_tasks: int = parameter(2, unit="tasks", low=1, high=MOST_TASKS, doc="tasks that wait")
    demand: float = parameter(
        1.0, unit="stimulus a tick", low=0.0, doc="δ, growth of each task's stimulus"
    )
    efficiency: float = parameter(
        3.0, unit="stimulus a tick", low=0.0, doc="α, what a task loses when all are at it"
    )
    giving_up: float = parameter(
        0.2, unit="probability a tick", low=0.0, high=1.0, doc="p, chance to stop working"
    )
    threshold: float = parameter(
        500.0, unit="stimulus", low=0.001, doc="θ of a worker at the start, for all tasks"
    )
    n_majors: int = parameter(0, unit="workers", low=0, doc="workers of a second caste")
    majors_threshold: float = parameter(
        500.0, unit="stimulus", low=0.001, doc="θ of the second caste at the start"
    )
    learning: float = parameter(
        10.0, unit="stimulus a tick", low=0.0, doc="ξ, by which θ falls while working"
    )
    forgetting: float = parameter(
        1.0, unit="stimulus a tick", low=0.0, doc="φ, by which θ rises while not working"
    )
    lowest_threshold: float = parameter(1.0, unit="stimulus", low=0.001, doc="least θ")
    highest_threshold: float = parameter(1000.0, unit="stimulus", low=0.001, doc="greatest θ")
    remove_at: int = parameter(
        -1, unit="ticks", low=-1, doc="when specialists are taken away; -1 for never"
    )
    removed_task: int = parameter(
        0, unit="task", low=0, high=MOST_TASKS - 1, doc="whose specialists are taken away"
    )
    return_at: int = parameter(
        -1, unit="ticks", low=-1, doc="when they are brought back; -1 for never"
    )
    forgetting_away: bool = parameter(True, doc="whether they forget while they are away")

    workers = Population(Worker, "n_workers")
    tasks = Population(Task, "n_tasks")

    setup = (each(workers, be_born),)
    schedule = (
        once(remove_or_return),
        each(workers, work),
        each(workers, learn),
        each(tasks, call, shuffled=False),
    )

    def series(self):
        """Return who is there and at work, and each task's stimulus, workers and specialists."""
        workers = self.workers
        doing, roles = workers.filled("task", -1), self.roles()
        numbers = {
            "present": int((~workers.away).sum()),
            "working": int((doing >= 0).sum()),
        }
        for task, stimulus in enumerate(self.tasks.stimulus.tolist()):
            numbers[f"stimulus_{task}"] = stimulus
            numbers[f"working_{task}"] = int((doing == task).sum())
            numbers[f"specialists_{task}"] = int(((roles == task) & ~workers.away).sum())
        return numbers

    def agents(self):
        """Return each worker's caste, task, role, thresholds and work so far."""
        workers = self.workers
        columns = {
            "agent": workers.id,
            "major": workers.major,
            "away": workers.away,
            "task": workers.task,
            "role": [None if role < 0 else role for role in self.roles().tolist()],
        }
        for task in range(self.n_tasks):
            columns[f"threshold_{task}"] = workers.thresholds[:, task]
            columns[f"done_{task}"] = workers.done[:, task]
        return columns

    def roles(self):
        """Return the task that each worker is a specialist of, an array; -1 for none."""
        own = np.sort(self.workers.thresholds[:, : self.n_tasks], axis=1)
        middle = (self.lowest_threshold + self.highest_threshold) / 2
        special = own[:, 0] < middle
        if self.n_tasks > 1:
            special &= own[:, 0] < own[:, 1]
        lowest = self.workers.thresholds[:, : self.n_tasks].argmin(axis=1)
        return np.where(special, lowest, -1)
