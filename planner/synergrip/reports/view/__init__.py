"""What is seen of a hand that holds an object, in three dimensions."""
