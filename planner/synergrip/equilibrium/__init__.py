"""The nonlinear statics of a grasp on a hand: where hand and object really come to rest."""
