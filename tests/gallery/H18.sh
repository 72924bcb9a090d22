# H18: two sliders coupled by mass, one on the other, 10:1: largest energy over that at the start.
pair cart 0.01
