/* file.h -- a reduced flexible body as a JSON file.
 *
 *     {"fmdsub_flex": 1, "modes": n, "reference": 0, "at": [3], "mass": m, "xx": [9], ..., "K": [n n], "D", "hertz",
 *      "nodes": [{"name": "root", "x": [3], "phi": [3 n], "psi": [3 n], "S": [3 n n]}, ...],
 *      "stresses": [{"name": "root", "tensor": [6 n], "axial": [n], "bending": [n]}, ...],
 *      "checksum": "16 hexadecimal digits"}
 *
 * Members are those of struct flex_body, arrays in the same order, SI units; "at" is where the centre of mass was in
 * the axes of the mesh.  D, hertz, s with xs, S, T, name, axial with bending may be missing; "comment" may be anywhere, and
 * any other member is refused.  Numbers read back to the same bits.  The checksum, where there is one, stands last and is that of the text before it without white space. */
#ifndef FMDSUB_FLEX_FILE_H
#define FMDSUB_FLEX_FILE_H

#include <stdint.h>

#include "base/status.h"
#include "flex/body.h"

/* The body as text, its lines ended; never NULL. */
const char *flex_file_text(const struct flex_body *o, const double *at, struct arena *life);

/* Of text [n]; white space does not count. */
uint64_t flex_file_checksum(const char *text, size_t n);

/* at [3] or NULL.  Refused, with the file and the member: what the checksum says was changed, what is unknown, missing, has another size, is not finite, no
 * symmetric K or pairs i, j, a mass or an inertia that is not positive, a reference that moves.  E_FILE where it cannot
 * be read, else E_DECK. */
enum status flex_file_read(struct flex_body **out, double *at, const char *path, struct arena *life,
                           struct report *report);

#endif
