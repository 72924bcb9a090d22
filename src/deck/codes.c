/* codes.c -- every code of a deck message and its cure: one table for `fmdsub explain CODE` and the manual.
 *
 * Every stage that tells of decks adds its codes here; a test compares the table with the sources. */
#include <stddef.h>
#include <strings.h>

#include "deck/diag.h"

const struct diag_help diag_helps[] = {
    /* the text */
    {"E-encoding", "A deck is UTF-8 text. Save the file as UTF-8; an editor that shows the marked line can replace the "
                   "character there. UTF-16 is not read."},
    {"E-character",
     "Control characters and zero bytes have no place in a deck. Delete the character, or write it as an escape "
     "such as \"\\t\" inside double quotes."},
    {"E-yaml",
     "The text is not YAML at the marked place. Look for a missing ':' or ',', a quote or bracket that is not "
     "closed, or a line indented differently from its neighbours."},
    {"E-tab", "YAML indents by spaces only. Replace the tab by spaces."},
    {"E-unclosed", "A bracket, brace or quote is not closed. The second place shows where it was opened."},
    {"E-indent",
     "A line stands at a depth that fits neither the block above nor the one around it. Members of one map begin "
     "in the same column."},
    {"E-colon", "YAML wants a space after the ':' that follows a key: write 'key: value'."},
    {"E-comma",
     "Inside { } and [ ] a comma ends a value. Put an expression that holds a comma into quotes: \"atan2(y, x)\"."},
    {"E-anchor", "An alias (*name) needs an anchor (&name) before it that is not around it, and a name is given to one "
                 "anchor only."},
    {"E-key", "Keys are plain words. Lists, maps, aliases and empty texts cannot be keys."},
    {"E-merge", "'<<' is not read. Use include: to share a part between decks, repeat: for many like members, or an "
                "alias for a whole value."},
    {"E-tag", "Decks need no tags (!...). Delete the tag; to keep digits as text, quote them."},
    {"E-documents", "A deck is one YAML document. Delete what follows the second '---', or make it a deck of its own."},
    {"E-empty", "The deck is empty. `fmdsub new` writes one to start from."},
    {"E-duplicate", "A key may be given once in a map. Delete one of the two, or rename it."},
    {"E-effects",
     "'effects' turns off what this scene needs: 'out_of_plane: false' is for scenes whose joints keep every "
     "body in planes of one normal. Leave it to 'auto', which does this by itself."},
    /* limits */
    {"E-limit-depth", "Lists and maps may be nested 64 deep."},
    {"E-limit-anchors", "A deck may hold 1000 anchors and 1000 aliases."},
    {"E-limit-nodes", "A deck may hold 1000000 values after aliases, and 2000000 after repeat:. Put long tables into a "
                      "CSV file beside the deck."},
    {"E-limit-scalar", "One text may be 1 MiB long. Put long tables into a CSV file beside the deck."},
    {"E-limit-repeat", "repeat: may make 100000 copies in all."},
    {"E-limit-expression",
     "An expression may be 65536 characters long, nested 64 deep, and hold 63 operands at a time. Give parts "
     "of it names in parameters:."},
    {"E-limit-file", "A file named in a deck may be 16 MiB long."},
    /* include, --set, parameters, repeat */
    {"E-include",
     "include: names a YAML file, or a list of them, in the deck's own folder or below it. Files may include "
     "others, 16 deep and not in a circle."},
    {"E-conflict",
     "Two included files give different values for one key. Give the value in the deck itself: it wins over "
     "included ones."},
    {"E-set", "--set takes path=value: the keys down to a value, joined by dots, list items by their number from 0. "
              "Example: --set integrate.ratio=5. A key that holds a dot can be quoted."},
    {"E-parameter",
     "A parameter is a name ([A-Za-z][A-Za-z0-9_]*) with a number or an expression of other parameters."},
    {"E-cycle", "Parameters, or signals, are given by each other in a circle. Give one of them by something else."},
    {"E-repeat",
     "A member with $i in its key is copied: link$i: {repeat: {i: [1, 10]}, ...}. $i, or $(i - 1), is replaced in "
     "keys and texts below; in numbers the variable is known as i."},
    /* keys and values */
    {"E-unknown-key",
     "The key means nothing here. Keys are checked so that a misspelt one is not lost; `fmdsub list` shows "
     "those that are known."},
    {"E-missing-key", "A key that has no default is missing."},
    {"E-type",
     "The value has another shape than its key needs: a number, a text, a list [a, b] or a map {key: value}."},
    {"E-number",
     "A number is decimal: 12, -0.5, 1.0e-3, or an expression of parameters. There are no unit words (SI units), "
     "no decimal comma, no hexadecimal, no infinity."},
    {"E-expression",
     "The expression cannot be read at the marked place. Known are + - * / ^ ( ), pi, the usual functions, and "
     "if(condition, a, b)."},
    {"E-range", "The number is outside of what its key allows."},
    {"E-integer", "The key needs a whole number."},
    {"E-boolean", "Write true or false. Words such as yes, no, on, off are texts in a deck."},
    {"E-choice", "The key takes one of a few words."},
    {"E-count",
     "The list has another number of items than its key needs: two in 2-D decks, three in 3-D decks, for vectors."},
    {"E-dimension", "The key is for decks of the other space (2-D or 3-D)."},
    {"E-path",
     "Files named in a deck lie in the deck's own folder or below it. Write a relative path without '..'; links must "
     "not lead out."},
    {"E-checkpoint", "A checkpoint goes into a file of the folder where the run is started: a plain name, without '/' "
                     "and without a '.' in front."},
    {"E-csv",
     "A CSV file holds the same number of columns of decimal numbers in every row, separated by commas, with at most "
     "one row of names at the top. Empty lines and lines after '#' are skipped."},
    /* the scene: names */
    {"E-name",
     "Names are letters, digits and '_', a letter first; ground, energy, momentum, step, t and type are taken."},
    {"E-duplicate-name",
     "Measures take no name of a joint or a body, which expressions and forces could not tell apart; "
     "and what two things are called may not make two columns of one name. Rename one of them."},
    {"E-unknown-name", "Forces act along a joint with one freedom, a coordinate (hub.angle), a measure, or between two "
                       "points; expressions read t, coordinates, rates (hub.angle_rate) and measures (gap, gap_rate)."},
    {"E-unknown-body", "The body is not under bodies:. The world is called ground."},
    {"E-unknown-point", "A point is a vector (fixed on the ground), a body (its centre of mass), or body.name from the "
                        "body's points:."},
    {"E-unknown-coordinate",
     "A coordinate is joint.name, such as hub.angle or guide.displacement; `fmdsub list columns DECK` shows them all."},
    {"E-unknown-column",
     "`fmdsub list columns DECK` shows every column of a deck; '*' and '?' match as in file names."},
    {"E-unknown-joint", "`fmdsub list joints` shows the kinds of joints."},
    {"E-unknown-measure", "A measure is a distance, a displacement along an axis, or an angle."},
    {"E-unknown-force", "`fmdsub list forces` shows the kinds of forces."},
    {"E-absent-scheme",
     "The scheme needs a library that was not there when this program was built: install the package that "
     "is named and build anew, or take another scheme; `fmdsub list schemes` shows them."},
    {"E-unknown-scheme", "`fmdsub list schemes` shows the integration schemes."},
    {"E-two-kinds", "Two keys say what the thing is, or give the same quantity. Keep one of them."},
    {"E-which-coordinate",
     "The joint has several freedoms, none, or turns freely: name one plain coordinate of it, or use "
     "a measure; a gear ties two different ones. Rates and elastic coordinates cannot stand for it."},
    /* the scene: bodies, joints, forces */
    {"E-no-bodies", "A scene needs a body besides the ground."},
    {"E-same-body", "Both ends are on one body: nothing moves between them, but between two places of a "
                    "flexible one. The world is called ground."},
    {"E-shape", "A shape is one of box, cylinder, rod, sphere, tube."},
    {"E-flexible", "The file is not a reduced body as fmdsub-reduce writes it, or it was changed since."},
    {"E-material",
     "A material has a name that the program knows, or its constants: {E: 70.0e+9, nu: 0.33, density: 2700}."},
    {"E-section",
     "A beam's section is a rectangle, a circle, a tube, or its numbers (area, Iz, in 3-D Iy and J); several "
     "go from station 0 to station 1. Shear needs ky and kz beside numbers, stresses half sizes y and z."},
    {"E-beam",
     "The finite elements of the beam do not go with what is asked of them: take fewer modes or more elements, "
     "and look at its section and material."},
    {"E-inertia", "The tensor belongs to no body. Moments about any three axes at right angles are positive and none "
                  "exceeds the sum of the other two; check units, and whether the tensor is about the centre of "
                  "mass. With 'inertia_check: false' the body takes it as it is."},
    {"E-direction", "A direction must have a length, and two axes must not be parallel."},
    {"E-axes",
     "The two axes of a universal joint stand at right angles, and so do x and z of an orientation. Oblique "
     "axes are those of a body without mass between two revolute joints: the message has the lines for the deck."},
    {"E-orientation", "Give x or z or both, or axis and angle, or a quaternion."},
    {"E-quaternion", "A unit quaternion [w, x, y, z]: the squares of its parts sum to 1."},
    {"E-loop",
     "The motion has no coordinates of a joint that closes a loop. Drive, push or start fewer joints of the loop, or "
     "measures."},
    {"W-redundant",
     "Joints of a loop hold the same freedom twice. Weaken one: a spherical for a revolute, a "
     "cylindrical for a prismatic. Where sizes that are to be the same differ by e, the motion near dead points is off "
     "by the root of e, the more so the more dead points it passes: a crank too long by 1e-8 of the size "
     "costs a hundredth of its rate after five of them. Give both the same expression."},
    {"W-assembly", "The joints of a loop miss each other as drawn. Give the places of its bodies with more digits."},
    {"E-ground", "A load must act on a body that can move."},
    {"E-hold",
     "'hold' is 'rigid' or a map of its keys: {restitution: 0.5}, or {stiffness: 1.0e+6} for stops that give way."},
    {"E-exclusive", "The marked key goes with another kind of stop or contact. 'stiffness' makes one compliant, then "
                    "'damping' or 'restitution' with its 'impact_speed', and 'exponent', say more of it."},
    {"E-unknown-surface",
     "The surface is not known here: surfaces stand in 'surfaces:', as plane, point, points, sphere, "
     "hole, profile or cam; a contact names two of them."},
    {"E-pair",
     "These two surfaces do not make a contact. Known are point or sphere and plane, hole, profile or cam, sphere "
     "and sphere or point."},
    {"E-static", "What sticks is held by at least the friction that resists sliding: 'static' is not below 'kinetic'."},
    {"E-hollow",
     "A disc touches a curve at one place. Where a hollow is narrower than the disc it would touch at two. Take a "
     "smaller disc, or a curve with wider hollows."},
    {"E-contact-flexible",
     "Rigid contacts are of rigid bodies; planes, balls and curves always are. A point of a flexible body touches by "
     "a compliant contact: give it a 'stiffness'. Or fix a small rigid body at the place, and let that touch."},
    {"E-points", "A surface of 'points' has one point or more, each of another place: a body rests on a place once. "
                 "Name points of the body, or delete the second of the two."},
    {"E-contact-linear",
     "Frequencies, stability maps and static equilibria do not know rigid contacts, which are closed or "
     "open. Delete the contact for them. Or make it compliant by a 'stiffness', of a joint's stop "
     "range: {hold: {stiffness: 1.0e+6}}."},
    {"E-jam",
     "The iteration that finds the forces of all rigid contacts at once did not converge. The usual causes are many "
     "points that touch at once, masses on each other that differ by large ratios, and more points than hold the "
     "body (three hold one on a plane, in 2-D two). Fewer points may help, or another step, larger or smaller. Or a "
     "drive presses bodies together: let a spring between give way. A joint with friction is wedged where that presses "
     "it "
     "harder than it slows it: a guide of length L whose load is h beside it, where the coefficient is above L/(2 h)."},
    {"E-friction-reaction",
     "Friction in a joint is its coefficient times the joint's force. Where a loop is held more often than it needs, "
     "as a four-bar of four parallel hinges in space, dynamics do not tell how its joints share their forces. Free "
     "what holds it twice, as by a spherical or cylindrical joint, or give the friction itself: friction: {torque: "
     "0.1}, or in a slide {force: 1}."},
    {"E-overlap", "A rigid contact starts inside of what it may not pass. Move the bodies apart in the drawing, or by "
                  "'initial'."},
    {"E-scheme-contact",
     "Rigid contacts cut steps where they strike, which the schemes midpoint and subcycle do. Leave 'scheme' out. A "
     "contact with a 'stiffness' is compliant, which every scheme takes; a joint's stop likewise, range: {hold: "
     "{stiffness: 1.0e+6}}."},
    {"E-damping", "rho_infinity below 1 takes out what the step does not resolve: midpoint and generalized-alpha from "
                  "0 to 1, hht from 0.5, newmark from 0 to 1 at the price of order 1, subcycle in what is fast. The "
                  "others have no such damping; midpoint keeps all energy of linear systems at any step."},
    {"E-stop-driven", "A drive prescribes a coordinate that stops hold within a range. Let a spring between them give "
                      "way: drive another joint, and put a spring along this one."},
    {"E-kind",
     "A force acts along a length, a torque along an angle. A gear ties two angles or two displacements, a rack "
     "an angle and then a displacement."},
    {"E-drive",
     "A drive gives a joint coordinate, a distance, a displacement or, in the plane, an angle as a function of "
     "time alone: an expression of t, or a table."},
    {"E-table", "A table has rows of two numbers, the first of which increase."},
    /* the scene: start and run */
    {"E-state",
     "A file of --final-state holds every coordinate and every rate of the deck that left it, and goes with that "
     "deck, as it was written. 'deck: any' beside 'from' takes coordinates and rates of another deck's, or of one "
     "that was edited and has lost its 'check', 'deck' and 'memory'. A run that keeps its time ends later than that."},
    {"E-states",
     "'static' finds a posture in which all stands still, but not what integrals and filters are there. Run the deck "
     "until it has come to rest, and go on from that: --final-state rest.json, initial: {from: rest.json}."},
    {"E-initial", "A free rotation is set as joint.rotation, its rate as joint.omega."},
    {"E-partition", "Spherical and free joints are fast or slow as a whole; a flexible body's modes one by one, all of "
                    "them, or those above a frequency."},
    {"E-newmark", "Newmark's method is stable for every step if 2 beta >= gamma >= 1/2."},
    {"E-order", "Order 4 goes with fixed steps and without damping by rho_infinity."},
    {"E-step", "The step is too long or too short for the run."},
    {"E-ratio", "A major step (ratio times step) must fit into the run."},
    {"E-every", "Records fall on the ends of major steps: 'every' is a multiple of ratio times step, or {steps: N}."},
    /* warnings */
    {"W-units",
     "The number is far from what is usual in SI units (m, kg, s, rad, N). If it is meant, nothing is wrong."},
    {"W-quaternion", "The quaternion was scaled to length 1."},
    {"W-offset", "The place belongs to the beam's nearest section, or to the nearest node of a body from a file, and "
                 "moves with it as if it were rigid. If it should stand on the axis or on a node, change its place."},
    {"W-slide", "A slide, a pin in a slot or a nut runs on a straight line that is fixed to one section of the beam, "
                "that under the joint as drawn, and loads the beam there wherever it runs. That is right for a travel "
                "that is short beside the beam's length; no joint runs along the beam as it bends."},
    {"W-shear",
     "A beam that is not slender bends by shear, too: the share told is that of a force at the end of the beam held at "
     "the other, across where it bends most easily; of vibrations it is more, as their waves are shorter. Beams have "
     "shear where "
     "'shear: true' stands beside their ends, or 'effects: {shear: true}' in the deck, or sections give ky, kz."},
    {"W-stiffening", "Without geometric stiffening a beam that turns, or carries loads along its axis, bends too much: "
                     "right for small loads only. From the speed named, that of the body held at its inboard joint "
                     "alone, it bends away without bound, which no real beam does; the energy balance does not show "
                     "it. Take 'stiffening: false' out."},
    {"W-scheme",
     "The key belongs to other schemes and changes nothing here. Take it out, or choose one of those. Keys of "
     "a deck whose scheme --set has changed are passed over without a word. Only 'fast' has a say under any scheme "
     "where bodies form loops: in what starts at 0, of what 'initial' does not set."},
    {"W-expression-stop",
     "A force that is 0 up to some place and pushes back beyond it is a stop: unilateral: x, with its stiffness, has "
     "its energy in the balance and keeps it at any step, which as an expression only small steps do; range: {hold: "
     "rigid} of a joint has no stiffness to choose. A hint: nothing is wrong, and --strict does not mind."},
    {"W-unused", "What the deck gives changes nothing. Take it out, or look for the name that it should have had."},
    {"W-partition", "Where no coordinate is fast, everything takes the major step, ratio times step. Name the fast "
                    "coordinates in partition:, or take ratio 1. Where all are fast, as in one loop with a fast "
                    "coordinate, everything takes the minor step, and a ratio saves nothing."},
    {"W-pulse",
     "A load changes twice within one fixed step: on and off again, say. The step asks for it at a few times, or "
     "takes its mean, and what comes and goes between is missed or counted for a whole step. Take a step by which "
     "both times are ends of steps, or give a 'tolerance': a scheme that chooses its steps steps onto the times at "
     "which an expression of t or a table is known to change. A smooth pulse, or a vibration of less than three "
     "steps, is told the same way: steps must be parts of it; a tolerance may step over a narrow one, too, where "
     "nothing else is going on."},
    {"W-corner",
     "The rate of a drive jumps while joints rub or rigid contacts are closed on what it moves, or what hangs on that "
     "by joints and closed contacts. Such a corner strikes all of these; friction, which would take up to its "
     "coefficient of what joints and contacts bear of the blow, does not take that part, or one that goes by the step,"
     " and the impulses that contacts count are not what they bear. No smaller step mends it. Round the corner: let "
     "the rate go from one value to the other in a short time, as smooth(t, a, b) does, or by a piece of t^2 in an "
     "if(); 1.0e-4 s is short enough for most. Steps have to be shorter than that, or chosen by a 'tolerance'."},
    {"W-time",
     "Drives and forces that are functions of time begin anew from the state of an earlier run. Beside 'from', "
     "'time: keep' lets the clock go on ('until' then is later than the state), 'time: zero' starts it anew."},
    {"W-drive-start",
     "At t = 0 the drive's value is not that of the drawn position, and the mechanism is moved there before the run. "
     "Draw it there, say so by 'initial: {joint.coordinate: value}' or 'initial: {assemble: true}', or let the "
     "drive begin where it is drawn: a distance with its length, a coordinate with 0."},
    {"W-drive", "The drive's rate changes within the slow coordinates' step. What it moves takes the small step now; a "
                "smaller ratio would let it be slow."},
    {"W-damping", "Of a beam in segments 'ratio' and 'alpha' are of the motion of each segment against its own frame, "
                  "and damp the slow modes of the whole beam by next to nothing. 'beta' is the material's and does "
                  "not depend on the number of segments: beta = 2*z/omega gives the mode of omega rad/s the damping "
                  "ratio z; `fmdsub modes` shows both."},
    {"W-bending",
     "A flexible body has one frame, in which it may bend by about a fifth of its length. Farther bending is "
     "followed by several: give the beam 'segments', or more of them. A beam with 'stiffening: false' bends too far as "
     "soon as it turns or carries loads along its axis: take that out first."},
    {"W-bushing",
     "A bushing with different stiffnesses about its axes tilted by more than 0.5 rad. Large rotations are measured "
     "as swing and twist, see fmdsub-deck(5): exact about one axis, but a convention where two meet. If the joint is "
     "meant to turn far, give it a joint of its own, or stiffnesses that are the same all round its axis."},
    {"W-effect",
     "The deck has turned an effect off, and what it would have done was watched: it is more than the tolerance of "
     "'effects' allows, which is a tenth of the run's own at most. Of a column the number is what a second run with "
     "the effect found; of how a body bends a share by records, right within a factor of about three. Turn the "
     "effect on, or give a tolerance that fits. Of a scene that is stepped in a plane: what bends there would buckle "
     "out of it, which no symmetric computation shows by itself."},
    {"W-resolve",
     "A fast coordinate vibrates, and the minor steps of sub-cycling are too long for it: omega h above 2, with "
     "more than a millionth of the energy of motion. Its energy is kept, so that the balance is, but nothing of its "
     "phase is right, and its mean is where the vibration is symmetric only. Take a step of omega h = 0.3, `scheme: "
     "auto` with a tolerance, or 'rho_infinity' below 1, which takes the vibration out."},
    {"W-damped",
     "A scheme that damps, by rho_infinity below 1 or where the guard acts, has taken away motion that the step "
     "does not resolve: within few steps, and more than energy.delta of the energy that is there. The balance is "
     "kept, but what that motion would have done to all else is missing, and no estimate of the error knows of it. "
     "Take a smaller step; where that motion is of no interest, begin without it."},
    {"W-tolerance",
     "The estimated error is above 300 tolerances, or above a twentieth, whatever the tolerance. A tolerance holds "
     "what a single step leaves; the run adds that up, and a motion that turns on and on, or that parts from others "
     "near it, makes more of it. Of speeds, forces and energies the error is taken over their size where they change "
     "by less than that. The estimate is meant to be right within a factor of thirty: --verify makes a second run at a "
     "tenth of the tolerance and prints what differs. Take a tolerance smaller by about as much as the error is "
     "larger."},
    {"W-branch",
     "Where the bars of a parallelogram lie in one line it can go on as one or fold: branches meet. The rates "
     "of 'initial' have said which way, and the run starts a little along it. Drawn a little to one side, "
     "it needs no such help."},
    {"W-inertia",
     "The body has 'inertia_check: false', and an inertia that no body can have: a principal moment is negative "
     "or exceeds the sum of the other two. It is taken as it is; a run stops where the mass matrix is not "
     "positive. Mend it, if its source can tell the right one."},
    {"W-idle",
     "A body can turn about an axis for which it has no inertia, or next to none, as a slender rod between two "
     "spherical joints about itself, or a point mass on one. The turn moves nothing and nothing moves it: it is held "
     "still, and the body's angles and its rate about that axis say nothing. Where it has any inertia, a force on it "
     "or "
     "a rate at the start sets it free. Else give the body inertia there, or a joint that does not let it turn "
     "(universal for spherical), if that matters."},
    {"W-modes",
     "Modes of a beam have one frequency, as those of a round shaft in its two planes or of its equal spans, and "
     "'modes' cuts between them: with some of them the beam bends differently in its planes or spans, and what whirls, "
     "whirls wrongly. Take one of the two numbers that the message names."},
    {"W-kept",
     "The beam bends by a drive, a force on a joint, gravity or a load, and its modes have less than half of what the "
     "whole beam would do at rest: modes come by frequency, and all of the lowest may bend it in another plane. Take "
     "more modes, or make the place of a load a point with 'static: true'. `fmdsub check` shows the kind of each mode "
     "and what they keep. Directions 10 000 times stiffer than the softest are passed over."},
    {"W-unconnected", "No joint leads from the body to the ground, and it has no surface to stand on. If that is "
                      "meant, give it a free joint."},
    {"W-denormal", "The number is so small that it has lost digits (below 2.2e-308)."},
    /* stops and verdicts */
    {"no-convergence",
     "The iteration of a step did not converge, though the step was halved ten times. Where the motion is stiff, a "
     "smaller step or ratio helps. Where all steps fail, something jumps: sign(), a comparison in if(), a table with "
     "a step. Let it pass from one value to the other over a small way (tanh(rate/0.01) for sign(rate)), or look "
     "whether the mechanism comes to a dead point there (`fmdsub explain dead-point`)."},
    {"dead-point",
     "In this posture the loops leave more than one way open, or none: a linkage stretched out, a parallelogram that "
     "lies flat, or a mechanism that is locked. At the start: draw it in another posture, or set a coordinate by "
     "'initial:' a little to the side on which it is to go on. In a run: try a smaller step, or drive a coordinate "
     "that still moves there. A mechanism without any way is locked: take a joint that holds too much, see `fmdsub "
     "explain W-redundant`."},
    {"locked", "No small motion closes the loops: see `fmdsub explain dead-point`."},
    {"no-mass",
     "A coordinate moves no mass, so that a force along it has no acceleration to answer with. Give the bodies that it "
     "moves mass and, where they turn, inertia; or hold it by a drive or a fixed joint."},
    {"singular",
     "The matrix of a step has no inverse: a body without mass or inertia, or a spring of negative stiffness that "
     "just holds the balance. Give the body mass, or try another step."},
    {"not-finite",
     "A force, a drive, the condition that ends the run or a state is no number (a division by 0, the root of a "
     "negative number, an overflow). Look at the expression that is named, and guard it: if(x > 0, sqrt(x), 0). If "
     "the motion grew before, the step is too large or the model is unstable."},
    {"bending",
     "The end of a flexible body has moved by more than its length, where its equations mean nothing. See `fmdsub "
     "explain W-bending` and `fmdsub explain W-stiffening`."},
    {"balance",
     "The energy at the end of a step is not what was there before plus the work done, by more than energy.delta of "
     "the largest work: the numbers of this run are wrong. Take a smaller step or ratio 1; the schemes midpoint and "
     "subcycle keep the balance best. Forces that jump, and stiff parts that the step does not resolve, break it; "
     "rho_infinity below 1 damps those, but not what a start does against dampers and springs that the step does "
     "not resolve: there it swings over, and puts in energy that nothing has."},
    {"no-equilibrium",
     "'static' looks for the nearest stable equilibrium and found none: a part that nothing holds, or forces that "
     "have no balance near the drawn posture. Where it ends in one that is unstable, as a pendulum upside down, it "
     "names what falls away. Hold the part, or start nearer by 'initial:'."},
    {"drive-jump",
     "A drive's value jumps, which no force can follow. Let it move there in some time: a ramp, or a table."},
    {"memory", "The run needs more memory than --max-memory, or the machine, has. Only matrices of all freedoms are "
               "large: forces "
               "between bodies that are not joined to each other, and freedoms without mass, ask for them."},
    {"friction",
     "Surfaces that touch have Coulomb's friction, which sticks exactly: contacts: {foot: {between: [toe, floor], "
     "friction: 0.3}}. So have revolute and prismatic joints, by their own force: pin: {revolute: [a, b], at: [0, "
     "0], friction: {coefficient: 0.3, radius: 0.02}}, slide: {prismatic: [a, b], axis: [1, 0], friction: 0.2}; a "
     "seal's is a torque or a force. Viscous friction is a damper. Under a scheme other than midpoint dry friction "
     "can be written as a force of the rate that passes smoothly through 0: {force: slide, value: "
     "\"-10*tanh(slide.displacement_rate/0.001)\"}; sign() in its place jumps, and stops the run. It creeps instead "
     "of sticking, at a rate that the 0.001 sets."},
    {"contact",
     "Rigid contacts of points and spheres with planes, holes, profiles, cams and each other stand in 'surfaces' and "
     "'contacts', with Coulomb's friction; stops of a joint stand in its 'range'. Schemes midpoint, by a 'step' or a "
     "'tolerance', and subcycle, by a 'step', take them. With a "
     "'stiffness' they are compliant, for every scheme and for points of flexible bodies: the step must then resolve "
     "the time of touch, about 3*sqrt(mass/stiffness), where it matters, and friction creeps. A compliant contact "
     "along another distance is a force: {unilateral: gap, stiffness: 1.0e+5, side: below}."},
    {"rolling",
     "There is no rolling contact. A wheel that rolls without slip on a straight way is a rack: {rack: [wheel.angle, "
     "cart.displacement], radius: r}; two wheels on each other are a gear."},
    {NULL, NULL},
};

const char *diag_cure(const char *code)
{
    for (const struct diag_help *h = diag_helps; h->code; h++)
        if (!strcasecmp(h->code, code)) return h->cure;
    return NULL;
}
