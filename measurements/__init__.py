"""What the project measures of itself: accuracy against time, speeds, growth, cost of effects."""
