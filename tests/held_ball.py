"""A ball in the Barrett hand, made in code, and a task: what mistakes in code begin from."""

import synergrip as sg

hard = sg.HardFinger(friction=0.6)
hand = sg.load_hand("barrett")
ball = sg.Object(mass=0.2, shape=sg.Sphere(radius=0.05))
at = [sg.ContactAt(pad, hard, stiffness=8e3) for pad in ("finger1/tip", "finger2/tip", "finger3/tip")]
grasp = sg.make_grasp(hand, ball, posture="ball", synergies="motors", contacts=at)
task = sg.Task(duration=1.0, knots=3)
