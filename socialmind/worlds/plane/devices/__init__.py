"""The devices of robots: sensors, actuators, rewards, interruptions, and what is measured."""
