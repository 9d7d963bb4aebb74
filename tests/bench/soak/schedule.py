"""When the planned faults of a soak are due: one after the other, those for a job's start or end in the next job."""
from plan import END, NOW, START

RETRY = 0.5  # seconds until a fault that found nothing to hit is tried again


class Schedule:
    def __init__(self, planned, now):
        self.planned = list(planned)
        self.waiting = {START: [], END: []}  # for the next job's
        self.due = []                        # (time, fault)
        self.plan_next(now)

    def plan_next(self, now):
        self.next = now + self.planned[0].after if self.planned else float("inf")

    def left(self):
        return len(self.planned) + len(self.due) + sum(map(len, self.waiting.values()))

    def only_moments_left(self):
        return not self.planned and not self.due

    def come(self, moment, now):
        """A job starts, or ends: one fault is made in it."""
        if self.waiting[moment]:
            fault = self.waiting[moment].pop(0)
            self.due.append((now + fault.delay, fault))

    def take(self, now):
        """Those to be made now."""
        if now >= self.next:
            fault = self.planned.pop(0)
            if fault.moment == NOW:
                self.due.append((now, fault))
            else:
                self.waiting[fault.moment].append(fault)
            self.plan_next(now)
        ready = [fault for when, fault in self.due if when <= now]
        self.due = [(when, fault) for when, fault in self.due if when > now]
        return ready

    def put_back(self, fault, now):
        """It found nothing to hit: it is tried again a moment later, or in the next job, and sooner in it."""
        if fault.moment == NOW:
            self.due.append((now + RETRY, fault))
        else:
            fault.delay /= 2
            self.waiting[fault.moment].append(fault)
