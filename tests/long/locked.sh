# locked.sh -- tests/hard/locked.sh by schemes with a tolerance.
SCHEMES='radau5, tolerance: 1.0e-6
dopri5, tolerance: 1.0e-5' . tests/hard/locked.sh
