/* Computed torque of a SCARA in joint space, 1 kHz, against a simulated arm.

   tau = ID(q, v, a_d + Kd (v_d - v) + Kp (q_d - q)) makes the error of each joint e = q_d - q obey
   e'' + Kd e' + Kp e = 0, whatever the others do. The arm starts off its path, at the path's velocity; with
   Kd = 2 w, Kp = w^2 the error is then e(t) = e(0) (1 + w t) exp(-w t). The program prints the errors and how far
   they are from this, in parts of e(0), and returns 1 if that is more than what efforts held for a period explain. */
#include <math.h>
#include <stdio.h>

#include "scara.h"

#define N SCARA_NV

/* Seconds between two control steps, and steps of the simulated arm in that time. */
static const double PERIOD = 1e-3;
enum { STEPS = 1000, PARTS = 4 };
/* w of the errors, rad/s. */
static const double W = 16.0;
/* The path's beginning and end, and the errors at the start: rad; m for the quill. */
static const double FROM[N] = {0.4, -1.1, 0.03, 0.0};
static const double TO[N] = {-0.5, 1.2, 0.12, 1.5};
static const double OFF[N] = {0.03, -0.05, 0.004, 0.08};

/* Positions, velocities and accelerations of the path at the time t: a quintic from rest to rest. */
static void path(double t, double q[N], double v[N], double a[N])
{
    const double total = STEPS * PERIOD;
    const double x = t / total;
    const double s = x * x * x * (10.0 + x * (6.0 * x - 15.0));
    const double rate = 30.0 * x * x * (x - 1.0) * (x - 1.0) / total;
    const double curvature = 60.0 * x * (x - 1.0) * (2.0 * x - 1.0) / (total * total);
    for (int i = 0; i < N; ++i) {
        q[i] = FROM[i] + (TO[i] - FROM[i]) * s;
        v[i] = (TO[i] - FROM[i]) * rate;
        a[i] = (TO[i] - FROM[i]) * curvature;
    }
}

/* The efforts of a control step. */
static void control(double t, const double q[N], const double v[N], double tau[N])
{
    double q_path[N], v_path[N], a[N];
    path(t, q_path, v_path, a);
    for (int i = 0; i < N; ++i) {
        a[i] += 2.0 * W * (v_path[i] - v[i]) + W * W * (q_path[i] - q[i]);
    }
    scara_inverse_dynamics(q, v, a, tau);
}

/* Moves the arm by one period under constant efforts: Heun's method in PARTS steps. Returns the status of the arm. */
static int advance(double q[N], double v[N], const double tau[N])
{
    const double h = PERIOD / PARTS;
    for (int part = 0; part < PARTS; ++part) {
        double a[N], q1[N], v1[N], a1[N];
        int status = scara_forward_dynamics(q, v, tau, a);
        for (int i = 0; i < N; ++i) {
            q1[i] = q[i] + h * v[i];
            v1[i] = v[i] + h * a[i];
        }
        if (status == 0) {
            status = scara_forward_dynamics(q1, v1, tau, a1);
        }
        if (status != 0) {
            return status;
        }
        for (int i = 0; i < N; ++i) {
            q[i] += 0.5 * h * (v[i] + v1[i]);
            v[i] += 0.5 * h * (a[i] + a1[i]);
        }
    }
    return 0;
}

int main(void)
{
    double q[N], v[N], tau[N], q_path[N], v_path[N], a_path[N];
    path(0.0, q, v, a_path);
    for (int i = 0; i < N; ++i) {
        q[i] -= OFF[i];
    }
    printf("%8s", "t, ms");
    for (int i = 0; i < N; ++i) {
        printf(" %14s", scara_joint_names[i]);
    }
    printf(" %14s\n", "off, of e(0)");
    double largest = 0.0;
    for (int k = 0; k <= STEPS; ++k) {
        const double t = k * PERIOD;
        const double decay = (1.0 + W * t) * exp(-W * t);
        path(t, q_path, v_path, a_path);
        double off = 0.0;
        for (int i = 0; i < N; ++i) {
            off = fmax(off, fabs((q_path[i] - q[i]) / OFF[i] - decay));
        }
        largest = fmax(largest, off);
        if (k % 100 == 0) {
            printf("%8d", k);
            for (int i = 0; i < N; ++i) {
                printf(" %14.6e", q_path[i] - q[i]);
            }
            printf(" %14.6f\n", off);
        }
        control(t, q, v, tau);
        const int status = advance(q, v, tau);
        if (status != 0) {
            printf("no acceleration at %d ms: %d\n", k, status);
            return 1;
        }
    }
    printf("largest distance from e(0) (1 + w t) exp(-w t): %.4f e(0), %.4f allowed\n", largest, W * PERIOD);
    return largest <= W * PERIOD ? 0 : 1;
}
