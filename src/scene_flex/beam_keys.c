/* beam_keys.c -- the key tables of flexible bodies */
#include <math.h>

#include "scene_flex/flexible.h"

const struct key keys_beam_body[] = {
    PARAM_NODE(struct beam_body_keys, beam, "beam", "map", KEY_REQUIRED, "its axis and how it is divided"),
    PARAM_NODE(struct beam_body_keys, section, "section", "map", 0, "cross-section, the same all along"),
    PARAM_NODE(struct beam_body_keys, sections, "sections", "[{station: s, ...}, ...]", 0,
               "cross-sections from station 0 to 1: two of one shape change by their sizes, others by area and "
               "moments, linear between them, and so is the twist; two at one station between the ends make a step"),
    PARAM_NODE(struct beam_body_keys, material, "material", "name or map", KEY_REQUIRED,
               "steel, stainless, aluminium, titanium, magnesium, brass, or its constants"),
    PARAM_COUNT(
        struct beam_body_keys, modes, "modes", 1, 200, "auto", 0, "6",
        "elastic coordinates kept; auto: as many as the deck's loads, motions and columns ask for, to the tolerance "
        "of 'effects' (1.0e-3); each further joint than the first adds its freedoms (2-D: 3, 3-D: 6)"),
    PARAM_INT(
        struct beam_body_keys, segments, "segments", 1, 100, 0, "1",
        "for large bending: cut into bodies NAME1, NAME2, ... held together by fixed joints NAME_1, NAME_2, ...; "
        "stations, elements, points and their columns are of the whole: bending is seen from the part that carries "
        "the others; stresses are columns of the part that has their station, such as NAME1.s.bending"),
    PARAM_NODE(struct beam_body_keys, damping, "damping", "{alpha: a, beta: b} or {ratio: z}", 0,
               "of the material; default: none"),
    PARAM_NODE(struct beam_body_keys, masses, "masses", "{name: {station: s, mass: m}}", 0,
               "rigid masses carried by the beam"),
    PARAM_NODE(struct beam_body_keys, points, "points", "{name: {station: s}} or {name: vector [m]}", 0,
               "named points; a vector is in body axes, from the centre of mass"),
    PARAM_NODE(struct beam_body_keys, stress, "stress", "{name: {station: s, corner: top}}", 0,
               "named points where stresses are wanted"),
    PARAM_BOOL(struct beam_body_keys, stiffening, "stiffening", 0, "true",
               "geometric stiffening: bending shortens the beam, so that loads along it stiffen or soften it"),
    KEYS_END,
};

const struct key keys_beam[] = {
    PARAM_NODE(struct beam_keys, from, "from", "vector [m]", KEY_REQUIRED, "station 0 when drawn, world"),
    PARAM_NODE(struct beam_keys, to, "to", "vector [m]", KEY_REQUIRED,
               "station 1 when drawn; the body's x axis points there"),
    PARAM_NODE(struct beam_keys, up, "up", "vector", KEY_SPATIAL,
               "the body's z axis leans to it; default: [0, 0, 1], for an upright beam [1, 0, 0]"),
    PARAM_INT(struct beam_keys, elements, "elements", 1, 1000, 0, "8", "of equal length"),
    PARAM_BOOL(struct beam_keys, shear, "shear", 0, NULL,
               "shear deformation (Timoshenko); default: where ky, kz are given"),
    PARAM_BOOL(struct beam_keys, rotary, "rotary", 0, "true", "rotary inertia of the sections counts"),
    KEYS_END,
};

#define SECTION_KEYS                                                                                                   \
    PARAM_NODE(struct section_keys, rectangle, "rectangle", "[width, height] [m]", 0,                                  \
               "2-D: height in the plane, width out of it; 3-D: height along z, width along y"),                       \
        PARAM_NODE(struct section_keys, circle, "circle", "radius [m]", 0, "solid"),                                   \
        PARAM_NODE(struct section_keys, tube, "tube", "[outer radius, inner radius] [m]", 0, "round"),                 \
        PARAM_REAL(struct section_keys, area, "area", "m2", 0, INFINITY, KEY_ABOVE, NULL, "any other section's area"), \
        PARAM_REAL(struct section_keys, Iz, "Iz", "m4", 0, INFINITY, KEY_ABOVE, NULL,                                  \
                   "its integral of y^2: bending in the plane of x and y"),                                            \
        PARAM_REAL(struct section_keys, Iy, "Iy", "m4", 0, INFINITY, KEY_ABOVE | KEY_SPATIAL, NULL,                    \
                   "its integral of z^2: bending in the plane of x and z"),                                            \
        PARAM_REAL(struct section_keys, J, "J", "m4", 0, INFINITY, KEY_ABOVE | KEY_SPATIAL, NULL,                      \
                   "its torsion constant"),                                                                            \
        PARAM_REAL(struct section_keys, ky, "ky", NULL, 0, 2, KEY_ABOVE, NULL,                                         \
                   "shear area over area, forces along y; default: of the shape (Cowper 1966)"),                       \
        PARAM_REAL(struct section_keys, kz, "kz", NULL, 0, 2, KEY_ABOVE | KEY_SPATIAL, NULL,                           \
                   "likewise, forces along z"),                                                                        \
        PARAM_REAL(struct section_keys, y, "y", "m", 0, INFINITY, KEY_ABOVE, NULL,                                     \
                   "half its size along y, for stresses"),                                                             \
        PARAM_REAL(struct section_keys, z, "z", "m", 0, INFINITY, KEY_ABOVE | KEY_SPATIAL, NULL,                       \
                   "half its size along z, for stresses")

const struct key keys_section[] = {SECTION_KEYS, KEYS_END};

const struct key keys_sections[] = {
    PARAM_REAL(struct section_keys, station, "station", NULL, 0, 1, KEY_REQUIRED, NULL, "0 ... 1 along the beam"),
    PARAM_REAL(struct section_keys, twist, "twist", "rad", -INFINITY, INFINITY, KEY_SPATIAL, "0",
               "turn of the section about x"),
    SECTION_KEYS,
    KEYS_END,
};

const struct key keys_material[] = {
    PARAM_REAL(struct material_keys, E, "E", "Pa", 0, INFINITY, KEY_REQUIRED | KEY_ABOVE, NULL, "Young's modulus"),
    PARAM_REAL(struct material_keys, nu, "nu", NULL, -1, 0.5, KEY_ABOVE, NULL, "Poisson's ratio; gives G"),
    PARAM_REAL(struct material_keys, G, "G", "Pa", 0, INFINITY, KEY_ABOVE, NULL, "shear modulus"),
    PARAM_REAL(struct material_keys, density, "density", "kg/m3", 0, INFINITY, KEY_REQUIRED | KEY_ABOVE, NULL,
               "mass per volume"),
    KEYS_END,
};

const struct key keys_damping[] = {
    PARAM_REAL(struct damping_keys, alpha, "alpha", "1/s", 0, INFINITY, 0, "0", "D = alpha M + beta K"),
    PARAM_REAL(struct damping_keys, beta, "beta", "s", 0, INFINITY, 0, "0", "D = alpha M + beta K"),
    PARAM_REAL(
        struct damping_keys, ratio, "ratio", NULL, 0, 1, KEY_BELOW, "0",
        "the same share of critical damping in every mode of the beam as it is held for them; not with segments"),
    KEYS_END,
};

const struct key keys_lump[] = {
    PARAM_REAL(struct lump_keys, station, "station", NULL, 0, 1, KEY_REQUIRED, NULL, "0 ... 1 along the beam"),
    PARAM_REAL(struct lump_keys, mass, "mass", "kg", 0, INFINITY, KEY_REQUIRED, NULL, "with its centre on the axis"),
    PARAM_NODE(struct lump_keys, inertia, "inertia", "2-D: number; 3-D: [xx, yy, zz] or [xx, yy, zz, xy, xz, yz]", 0,
               "about its centre, body axes [kg m2]; default 0"),
    KEYS_END,
};

const struct key keys_station[] = {
    PARAM_REAL(struct station_keys, station, "station", NULL, 0, 1, KEY_REQUIRED, NULL, "0 ... 1 along the beam"),
    PARAM_NODE(struct station_keys, offset, "offset", "vector [m]", 0,
               "from the axis, body axes: carried rigidly by the section"),
    PARAM_BOOL(struct station_keys, statics, "static", 0, "false",
               "keep how loads here stretch and bend the beam at rest, as at a joint: adds freedoms (2-D: 3, 3-D: 6)"),
    KEYS_END,
};

const struct key keys_probe[] = {
    PARAM_REAL(struct probe_keys, station, "station", NULL, 0, 1, KEY_REQUIRED, NULL, "0 ... 1 along the beam"),
    PARAM_WORD(struct probe_keys, corner, "corner", "top|bottom|left|right|top-left|top-right|bottom-left|bottom-right",
               0, NULL, "top: largest y in 2-D, largest z in 3-D; left: largest y in 3-D; default: y and z"),
    PARAM_REAL(struct probe_keys, y, "y", NULL, -1, 1, 0, NULL, "place in the section, in half sizes; default 0"),
    PARAM_REAL(struct probe_keys, z, "z", NULL, -1, 1, KEY_SPATIAL, NULL,
               "place in the section, in half sizes; default 0"),
    KEYS_END,
};
