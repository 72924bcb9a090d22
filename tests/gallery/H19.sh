# H19: two sliders in major steps of half a period of the fast one: largest energy over that at the start.
pair ground 0.00628318530717958648
