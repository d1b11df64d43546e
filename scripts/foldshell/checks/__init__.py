"""What a state of stress is judged by: strengths, utilization, and whether the model is valid."""
