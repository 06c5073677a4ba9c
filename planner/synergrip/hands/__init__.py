"""What the robot is: joints, limits, compliance, synergies, kinematics."""
