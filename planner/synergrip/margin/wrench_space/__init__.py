"""The classical figures of a grasp: what its contacts can do to the object with normal forces of one newton."""
