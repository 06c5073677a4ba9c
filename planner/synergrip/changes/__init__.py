"""Single numbers of a task, others tried: what could be another one, and how far it must or may go."""
