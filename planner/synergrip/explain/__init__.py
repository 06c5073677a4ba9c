"""What would make a task feasible that is not."""
