"""A plan played in a physics engine, by a model that is written from plan.json alone."""
