import os

# What pages run must not find a checkout's data by chance.
os.environ.pop("SIGMASCAPE_DATA", None)
