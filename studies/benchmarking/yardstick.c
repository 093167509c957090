/* The rise of a hydraulic support with a loose rear-link pin, in two free coordinates: the turns of canopy and
   rear link. Closed-form posture (circles that meet), equations of motion by virtual power, Dormand and Prince's
   5(4) with error control, touches and partings located on its interpolation. The columns extend by a cubic step.

   Reads numbers from the standard input, in the order of `read_input`, and writes a report in JSON. SI throughout.
   What is timed, by the monotonic clock, is the run from the start posture to the last record. */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* --- the machine, as read --- */
static struct {
    double front_head[2], rear_head[2], canopy[2];   /* E, G, centre of mass, from I, reference posture */
    double front_foot[2], rear_foot[2], front_base[2], rear_base[2]; /* F, H, A, B */
    double front_length, rear_length, shield_length, link_length;    /* columns at the start, ID, AD */
    double hinge_side, shield_side;                  /* which of two intersections */
    double shield_pin[2], shield[2];                 /* C and centre of mass, from I, in parts of D - I */
    double front_link[2];                            /* centre of mass from A, in parts of D - A */
    double pin[2], rear_link[2];                     /* the link's end at B and centre of mass, from C */
    double canopy_m, canopy_j, shield_m, shield_j, front_m, front_j, rear_m, rear_j;
    double gx, gy;
    double clearance, bore_radius, stiffness, factor, floor;
    double mu, static_speed, ramp;
    double stroke, drive_start, drive_end;
    double duration, period, start_canopy, start_link, turn_weight, rate_weight;
} P;
static int runs;

static double number(void)
{
    double x;
    if (scanf("%lf", &x) != 1) {
        fprintf(stderr, "yardstick: too few numbers on the standard input\n");
        exit(2);
    }
    return x;
}

static void read_input(void)
{
    double *p = (double *)&P;
    for (size_t i = 0; i < sizeof P / sizeof(double); i++) p[i] = number();
    runs = (int)number();
}

/* --- drive --- */
static double D_s, D_v, D_a; /* extension, speed, acceleration of the columns */
static int rising;           /* whether the present segment is the stroke */
static double at_rest;       /* extension while it is not */

static inline void drive(double t)
{
    if (!rising) {
        D_s = at_rest;
        D_v = D_a = 0.0;
        return;
    }
    double w = P.drive_end - P.drive_start, x = (t - P.drive_start) / w;
    D_s = P.stroke * x * x * (3.0 - 2.0 * x);
    D_v = P.stroke * 6.0 * x * (1.0 - x) / w;
    D_a = P.stroke * (6.0 - 12.0 * x) / (w * w);
}

/* --- equations of motion --- */
typedef struct {
    double depth, rate, normal, friction, x, y;
} Contact;

static int touching;
static double touch_speed, damping; /* damping: chi / w */

static inline void meet(double ax, double ay, double ra, double bx, double by, double rb, double side, double *x,
                        double *y)
{
    double dx = bx - ax, dy = by - ay, square = dx * dx + dy * dy;
    double along = 0.5 * (1.0 + (ra * ra - rb * rb) / square);
    double across = side * sqrt(ra * ra / square - along * along);
    *x = ax + along * dx - across * dy;
    *y = ay + along * dy + across * dx;
}

/* y: turns of canopy and rear link, their rates; dy: its rate, or NULL if only the contact is wanted */
static void evaluate(double t, const double *y, double *dy, Contact *contact)
{
    drive(t);
    double cc = cos(y[0]), sc = sin(y[0]), cl = cos(y[1]), sl = sin(y[1]), q = y[2], r = y[3];
    double ex = cc * P.front_head[0] - sc * P.front_head[1], ey = sc * P.front_head[0] + cc * P.front_head[1];
    double gx = cc * P.rear_head[0] - sc * P.rear_head[1], gy = sc * P.rear_head[0] + cc * P.rear_head[1];
    double lf = P.front_length + D_s, lr = P.rear_length + D_s;
    double fcx = P.front_foot[0] - ex, fcy = P.front_foot[1] - ey;
    double rcx = P.rear_foot[0] - gx, rcy = P.rear_foot[1] - gy;
    double hx, hy, dx, dy_;
    meet(fcx, fcy, lf, rcx, rcy, lr, P.hinge_side, &hx, &hy);
    double ux = hx - fcx, uy = hy - fcy, wx = hx - rcx, wy = hy - rcy;
    meet(hx, hy, P.shield_length, P.front_base[0], P.front_base[1], P.link_length, P.shield_side, &dx, &dy_);
    double sx = dx - hx, sy = dy_ - hy, fx = dx - P.front_base[0], fy = dy_ - P.front_base[1];
    double cx = P.shield_pin[0] * sx - P.shield_pin[1] * sy, cy = P.shield_pin[0] * sy + P.shield_pin[1] * sx;
    double bx = cl * P.pin[0] - sl * P.pin[1], by = sl * P.pin[0] + cl * P.pin[1];
    double ox = hx + cx + bx - P.rear_base[0], oy = hy + cy + by - P.rear_base[1];
    double columns = 1.0 / (ux * wy - uy * wx), bars = 1.0 / (sx * fy - sy * fx);
    /* velocities per rate of the canopy: hinge, shield beam, front link, C */
    double a = ux * ey - uy * ex, b = wx * gy - wy * gx;
    double ix = (a * wy - b * uy) * columns, iy = (b * ux - a * wx) * columns;
    double is = -(ix * fx + iy * fy) * bars, il = -(ix * sx + iy * sy) * bars;
    double px = ix - is * cy, py = iy + is * cx;
    /* velocities */
    a = lf * D_v;
    b = lr * D_v;
    double vx = ix * q + (a * wy - b * uy) * columns, vy = iy * q + (b * ux - a * wx) * columns;
    double vs = -(vx * fx + vy * fy) * bars, vl = -(vx * sx + vy * sy) * bars;
    double ovx = vx - vs * cy - r * by, ovy = vy + vs * cx + r * bx;
    /* contact: the journal is the rear link's end, the bore the base's */
    double e = sqrt(ox * ox + oy * oy), away = e > 0.0 ? 1.0 / e : 0.0, nx = ox * away, ny = oy * away;
    double depth = e - P.clearance, rate = e > 0.0 ? nx * ovx + ny * ovy : sqrt(ovx * ovx + ovy * ovy);
    double normal = 0.0, friction = 0.0, arm = P.bore_radius + 0.5 * depth - e;
    if (touching && depth > 0.0) {
        normal = P.stiffness * depth * sqrt(depth) * (1.0 + damping * rate);
        if (normal < 0.0) normal = 0.0;
        if (P.mu > 0.0) {
            double slip = nx * ovy - ny * ovx + r * arm, share = (fabs(slip) - P.static_speed) / P.ramp;
            friction = P.mu * normal * (share < 0.0 ? 0.0 : share > 1.0 ? 1.0 : share);
            if (slip > 0.0) friction = -friction;
        }
    }
    contact->depth = depth;
    contact->rate = rate;
    contact->normal = normal;
    contact->friction = friction;
    contact->x = ox;
    contact->y = oy;
    if (!dy) return;
    double pushx = -normal * nx - friction * ny, pushy = -normal * ny + friction * nx, moment = arm * friction;
    /* accelerations at constant rates */
    double qq = q * q, ss = vs * vs, ll = vl * vl, rr = r * r;
    double vfx = vx - q * ey, vfy = vy + q * ex, vrx = vx - q * gy, vry = vy + q * gx;
    a = lf * D_a + D_v * D_v - (vfx * vfx + vfy * vfy) + qq * (ux * ex + uy * ey);
    b = lr * D_a + D_v * D_v - (vrx * vrx + vry * vry) + qq * (wx * gx + wy * gy);
    double ax = (a * wy - b * uy) * columns, ay = (b * ux - a * wx) * columns;
    double kx = ax - ss * sx + ll * fx, ky = ay - ss * sy + ll * fy;
    double as = -(kx * fx + ky * fy) * bars, al = -(kx * sx + ky * sy) * bars;
    double apx = ax - as * cy - ss * cx, apy = ay + as * cx - ss * cy;
    /* canopy */
    double mx = cc * P.canopy[0] - sc * P.canopy[1], my = sc * P.canopy[0] + cc * P.canopy[1];
    double tx = ix - my, ty = iy + mx, m = P.canopy_m;
    double m11 = m * (tx * tx + ty * ty) + P.canopy_j;
    double q1 = m * ((P.gx - ax + qq * mx) * tx + (P.gy - ay + qq * my) * ty);
    /* shield beam */
    mx = P.shield[0] * sx - P.shield[1] * sy;
    my = P.shield[0] * sy + P.shield[1] * sx;
    tx = ix - is * my;
    ty = iy + is * mx;
    m = P.shield_m;
    m11 += m * (tx * tx + ty * ty) + P.shield_j * is * is;
    q1 += m * ((P.gx - ax + as * my + ss * mx) * tx + (P.gy - ay - as * mx + ss * my) * ty) - P.shield_j * as * is;
    /* front link */
    mx = P.front_link[0] * fx - P.front_link[1] * fy;
    my = P.front_link[0] * fy + P.front_link[1] * fx;
    tx = -il * my;
    ty = il * mx;
    m = P.front_m;
    m11 += m * (tx * tx + ty * ty) + P.front_j * il * il;
    q1 += m * ((P.gx + al * my + ll * mx) * tx + (P.gy - al * mx + ll * my) * ty) - P.front_j * al * il;
    /* rear link */
    mx = cl * P.rear_link[0] - sl * P.rear_link[1];
    my = sl * P.rear_link[0] + cl * P.rear_link[1];
    m = P.rear_m;
    double wfx = m * (P.gx - apx + rr * mx), wfy = m * (P.gy - apy + rr * my);
    m11 += m * (px * px + py * py);
    double m12 = m * (py * mx - px * my), m22 = m * (mx * mx + my * my) + P.rear_j;
    q1 += (wfx + pushx) * px + (wfy + pushy) * py;
    double q2 = wfy * mx - wfx * my + pushy * bx - pushx * by + moment;
    double scale = 1.0 / (m11 * m22 - m12 * m12);
    dy[0] = q;
    dy[1] = r;
    dy[2] = (m22 * q1 - m12 * q2) * scale;
    dy[3] = (m11 * q2 - m12 * q1) * scale;
}

/* --- Dormand and Prince 5(4) --- */
static double k[7][4];

static double advance(double t, double h, const double *y, double *end, Contact *c)
{
    int i;
    for (i = 0; i < 4; i++) end[i] = y[i] + h * 0.2 * k[0][i];
    evaluate(t + 0.2 * h, end, k[1], c);
    for (i = 0; i < 4; i++) end[i] = y[i] + h * (3.0 / 40 * k[0][i] + 9.0 / 40 * k[1][i]);
    evaluate(t + 0.3 * h, end, k[2], c);
    for (i = 0; i < 4; i++) end[i] = y[i] + h * (44.0 / 45 * k[0][i] - 56.0 / 15 * k[1][i] + 32.0 / 9 * k[2][i]);
    evaluate(t + 0.8 * h, end, k[3], c);
    for (i = 0; i < 4; i++)
        end[i] = y[i] + h * (19372.0 / 6561 * k[0][i] - 25360.0 / 2187 * k[1][i] + 64448.0 / 6561 * k[2][i]
                             - 212.0 / 729 * k[3][i]);
    evaluate(t + 8.0 / 9 * h, end, k[4], c);
    for (i = 0; i < 4; i++)
        end[i] = y[i] + h * (9017.0 / 3168 * k[0][i] - 355.0 / 33 * k[1][i] + 46732.0 / 5247 * k[2][i]
                             + 49.0 / 176 * k[3][i] - 5103.0 / 18656 * k[4][i]);
    evaluate(t + h, end, k[5], c);
    for (i = 0; i < 4; i++)
        end[i] = y[i] + h * (35.0 / 384 * k[0][i] + 500.0 / 1113 * k[2][i] + 125.0 / 192 * k[3][i]
                             - 2187.0 / 6784 * k[4][i] + 11.0 / 84 * k[5][i]);
    evaluate(t + h, end, k[6], c);
    double sum = 0.0;
    for (i = 0; i < 4; i++) {
        double error = 71.0 / 57600 * k[0][i] - 71.0 / 16695 * k[2][i] + 71.0 / 1920 * k[3][i]
                       - 17253.0 / 339200 * k[4][i] + 22.0 / 525 * k[5][i] - 1.0 / 40 * k[6][i];
        error *= h * (i < 2 ? P.turn_weight : P.rate_weight);
        sum += error * error;
    }
    return sqrt(0.25 * sum);
}

static double path[5][4];

static void fit(double h, const double *y, const double *end)
{
    for (int i = 0; i < 4; i++) {
        double change = end[i] - y[i], bend = h * k[0][i] - change;
        path[0][i] = y[i];
        path[1][i] = change;
        path[2][i] = bend;
        path[3][i] = change - h * k[6][i] - bend;
        path[4][i] = h * (-12715105075.0 / 11282082432.0 * k[0][i] + 87487479700.0 / 32700410799.0 * k[2][i]
                          - 10690763975.0 / 1880347072.0 * k[3][i] + 701980252875.0 / 199316789632.0 * k[4][i]
                          - 1453857185.0 / 822651844.0 * k[5][i] + 69997945.0 / 29380423.0 * k[6][i]);
    }
}

static void within(double x, double *y)
{
    double z = 1.0 - x;
    for (int i = 0; i < 4; i++)
        y[i] = path[0][i] + x * (path[1][i] + z * (path[2][i] + x * (path[3][i] + z * path[4][i])));
}

/* --- touches and partings --- */
static double depth_within(double t, double h, double x)
{
    double y[4];
    Contact c;
    within(x, y);
    evaluate(t + x * h, y, NULL, &c);
    return c.depth;
}

/* the fraction at which the depth, whose signs at low and high differ, passes zero: false position (Illinois) */
static double crossing(double t, double h, double low, double high, double at_low, double at_high)
{
    double x = high;
    for (int n = 0; n < 60 && high - low > 1e-14; n++) {
        x = (low * at_high - high * at_low) / (at_high - at_low);
        double d = depth_within(t, h, x);
        if (fabs(d) < 1e-15) break;
        if ((d > 0.0) == (at_high > 0.0)) {
            high = x;
            at_high = d;
            at_low *= 0.5;
        } else {
            low = x;
            at_low = d;
            at_high *= 0.5;
        }
    }
    return x;
}

/* the first change of contact within a step, as a fraction of it; 2 if there is none, -1 if the step is too long */
static double change(double t, double h, const Contact *start, const Contact *end)
{
    double want = touching ? -1.0 : 1.0; /* sign of the depth after the change */
    double last = 0.0, before = start->depth, d;
    int parts = touching ? 2 : 4;
    /* a state just after a change lies on the wrong side by rounding, or on zero */
    int ready = want * before < -1e-13;
    if (touching && end->depth > 0.0 && !(start->rate < 0.0 && end->rate > 0.0)) return 2.0;
    /* in flight so far that a touch could hide between the looks: make the step shorter */
    if (!touching && hypot(end->x - start->x, end->y - start->y) > P.clearance) return -1.0;
    for (int n = 1; n <= parts; n++) {
        double x = (double)n / parts;
        d = n == parts ? end->depth : depth_within(t, h, x);
        if (want * d > 0.0) {
            if (!ready) return h < 1e-9 ? 2.0 : -1.0;
            return crossing(t, h, last, x, before, d);
        }
        ready = 1;
        last = x;
        before = d;
    }
    return 2.0;
}

/* --- a run --- */
#define MOST 4096
static double onset_time[MOST], onset_speed[MOST];
static int onsets;
static long steps, records;
static double *force;

static void record(double t, const double *y)
{
    Contact c;
    evaluate(t, y, NULL, &c);
    force[records++] = sqrt(c.normal * c.normal + c.friction * c.friction);
}

static void set_contact(int now, double speed)
{
    touching = now;
    touch_speed = speed;
    damping = P.factor / (speed > P.floor ? speed : P.floor);
}

static int run(long wanted)
{
    double y[4] = {P.start_canopy, P.start_link, 0.0, 0.0}, end[4], there[4], h = 1e-4, before = 1e-4;
    double stops[3] = {P.drive_start, P.drive_end, P.duration}, t = 0.0;
    Contact now, then;
    onsets = 0;
    steps = records = 0;
    at_rest = 0.0;
    rising = 0;
    set_contact(0, 0.0);
    record(0.0, y);
    for (int s = 0; s < 3; s++) {
        double stop = stops[s] < P.duration ? stops[s] : P.duration;
        if (t >= stop) continue;
        rising = s == 1;
        at_rest = s == 2 ? P.stroke : 0.0;
        evaluate(t, y, k[0], &now);
        while (t < stop) {
            int last = h >= 0.999999 * (stop - t);
            double full = h;
            if (last) h = stop - t;
            if (++steps > 10000000 || h < 1e-14) return 0;
            double error = advance(t, h, y, end, &then);
            if (!(error <= 1.0)) {
                double shrink = error < 1e30 ? 0.9 * pow(error, -0.2) : 0.2;
                h *= shrink > 0.2 ? shrink : 0.2;
                continue;
            }
            fit(h, y, end);
            double x = change(t, h, &now, &then);
            if (x < 0.0) {
                h *= 0.25;
                continue;
            }
            double grow = 0.9 * pow(error > 1e-9 ? error : 1e-9, -0.17) * pow(before, 0.04);
            double next = last ? full : h * (grow > 8.0 ? 8.0 : grow < 0.2 ? 0.2 : grow);
            before = error > 1e-4 ? error : 1e-4;
            int event = x < 2.0;
            if (event && x < 1.0) {
                h *= x;
                last = 0;
                /* the step made again differs from its interpolation: Newton's method on the depth at its end */
                for (int n = 0; n < 8; n++) {
                    advance(t, h, y, end, &then);
                    double following = h - then.depth / then.rate;
                    if (fabs(then.depth) < 1e-13 || !(following > 0.5 * h && following < 1.5 * h)) break;
                    h = following;
                }
                fit(h, y, end);
            }
            while (records < wanted && records * P.period <= t + h + 1e-12) {
                double at = (records * P.period - t) / h;
                within(at < 1.0 ? at : 1.0, there);
                record(records * P.period, there);
            }
            t = last ? stop : t + h;
            memcpy(y, end, sizeof y);
            if (event) {
                if (!touching) {
                    double speed = then.rate > 0.0 ? then.rate : 0.0;
                    if (onsets < MOST) {
                        onset_time[onsets] = t;
                        onset_speed[onsets++] = speed;
                    }
                    set_contact(1, speed);
                } else
                    set_contact(0, 0.0);
                evaluate(t, y, k[0], &now);
            } else {
                memcpy(k[0], k[6], sizeof k[0]);
                now = then;
            }
            h = next;
        }
    }
    return records == wanted;
}

static double clock_now(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return now.tv_sec + 1e-9 * now.tv_nsec;
}

int main(void)
{
    read_input();
    long wanted = (long)floor(P.duration / P.period + 1e-9) + 1;
    force = malloc(wanted * sizeof *force);
    double best = INFINITY;
    for (int n = 0; n < runs; n++) {
        double began = clock_now();
        if (!run(wanted)) {
            fprintf(stderr, "yardstick: the run could not be finished\n");
            return 3;
        }
        double took = clock_now() - began;
        if (took < best) best = took;
    }
    long from = (long)ceil(P.drive_start / P.period - 1e-9);
    double sum = 0.0;
    for (long i = from; i < wanted; i++) sum += force[i];
    printf("{\"seconds\": %.9g, \"mean\": %.12g, \"onsets\": [", best, from < wanted ? sum / (wanted - from) : 0.0);
    for (int i = 0; i < onsets; i++) printf("%s[%.12g, %.12g]", i ? ", " : "", onset_time[i], onset_speed[i]);
    printf("]}\n");
    return 0;
}
