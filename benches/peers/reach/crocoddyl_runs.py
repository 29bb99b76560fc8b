"""The task of `--example reach` in Crocoddyl: python crocoddyl_runs.py URDF PROBLEM.json. Prints times in µs as JSON.

One thread, the shortest of many, as the example measures itself. Crocoddyl multiplies the cost of a node by the step."""
import json
import sys
import time

import crocoddyl
import numpy as np
import pinocchio

ROUNDS = 60


def shooting(urdf, task):
    model = pinocchio.buildModelFromUrdf(urdf)
    frame = model.getFrameId("l_panda_joint7")
    state = crocoddyl.StateMultibody(model)
    actuation = crocoddyl.ActuationModelFull(state)
    first, holding = np.array(task["x0"]), np.array(task["gravity_efforts"])
    velocities = np.r_[np.zeros(model.nv), np.ones(model.nv)]

    def costs(of_v, of_p, of_u):
        speed = crocoddyl.ResidualModelState(state, first, actuation.nu)
        place = crocoddyl.ResidualModelFrameTranslation(state, frame, np.array(task["target"]), actuation.nu)
        total = crocoddyl.CostModelSum(state)
        total.addCost("v", crocoddyl.CostModelResidual(state, crocoddyl.ActivationModelWeightedQuad(velocities), speed), of_v)
        total.addCost("p", crocoddyl.CostModelResidual(state, place), of_p)
        if of_u:
            effort = crocoddyl.ResidualModelControl(state, holding)
            total.addCost("u", crocoddyl.CostModelResidual(state, effort), of_u)
        return total

    def action(total, step):
        dynamics = crocoddyl.DifferentialActionModelFreeFwdDynamics(state, actuation, total)
        return crocoddyl.IntegratedActionModelEuler(dynamics, step)

    weights, nodes = task["weights"], task["nodes"]
    node = action(costs(weights["v"], weights["p"], weights["u"]), task["step"])
    end = action(costs(weights["last_v"], weights["last_p"], None), 0.0)
    problem = crocoddyl.ShootingProblem(first, [node] * nodes, end)
    return problem, [first] * (nodes + 1), [holding] * nodes


def shortest(call):
    def once():
        before = time.perf_counter_ns()
        call()
        return time.perf_counter_ns() - before

    return round(min(once() for _ in range(ROUNDS)) / 1e3, 1)


with open(sys.argv[2]) as file:
    problem, states, efforts = shooting(sys.argv[1], json.load(file))
solver = crocoddyl.SolverDDP(problem)
solver.th_stop = 1e-9
one = shortest(lambda: solver.solve(states, efforts, 1, False))
whole = shortest(lambda: solver.solve(states, efforts, 100, False))
print(json.dumps({"one_iteration_us": one, "solve_us": whole, "iterations": solver.iter, "cost": solver.cost}))
