# boxes.sh -- tests/hard/boxes.sh by closer tolerances.
TOLERANCES="1e-4 1e-5" . tests/hard/boxes.sh
