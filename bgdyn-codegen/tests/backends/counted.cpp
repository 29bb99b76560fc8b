// Compiles generated C with a number type that counts operations, and prints the counts of each function. Before this
// text stand the definition of `NAME(x)`, x with the prefix of all names, and that of `FILE_OF_C`.
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

struct Counts {
    long mul, add, div, sqrt, sincos, other;
};
static Counts counts;

struct Counted {
    double value;
    Counted() = default;
    Counted(double value) : value(value) {}
    Counted operator-() const { return Counted(-value); } // Negation is free.
};
static Counted operator+(Counted a, Counted b) { ++counts.add; return Counted(a.value + b.value); }
static Counted operator-(Counted a, Counted b) { ++counts.add; return Counted(a.value - b.value); }
static Counted operator*(Counted a, Counted b) { ++counts.mul; return Counted(a.value * b.value); }
static Counted operator/(Counted a, Counted b) { ++counts.div; return Counted(a.value / b.value); }
static bool operator<=(Counted a, Counted b) { return a.value <= b.value; }
static bool operator>(Counted a, Counted b) { return a.value > b.value; }
static bool operator<(Counted a, Counted b) { return a.value < b.value; }
static Counted fabs(Counted a) { return Counted(fabs(a.value)); }
static Counted sin(Counted a) { return Counted(sin(a.value)); }
static Counted cos(Counted a) { return Counted(cos(a.value)); }

// What counts as one operation, in place of the functions in the file: a pair of sine and cosine with the sum of its
// angles, and a checked pivot.
static void NAME(add_angle)(Counted *sum, Counted *, Counted angle) { *sum = Counted(sum->value + angle.value); }
static void NAME(sin_cos)(Counted angle, Counted *sine, Counted *cosine)
{
    ++counts.sincos;
    *sine = sin(angle);
    *cosine = cos(angle);
}
static void NAME(sin_cos_sum)(Counted angle, Counted, Counted *sine, Counted *cosine)
{
    NAME(sin_cos)(angle, sine, cosine);
}
static void NAME(sin_cos_pair)(Counted single, Counted sum, Counted, Counted sines[2], Counted cosines[2])
{
    NAME(sin_cos)(single, &sines[0], &cosines[0]);
    NAME(sin_cos)(sum, &sines[1], &cosines[1]);
}
static void NAME(sin_cos_all)(int count, const Counted *angles, const Counted *, Counted *sines, Counted *cosines)
{
    for (int k = 0; k < count; ++k) {
        NAME(sin_cos)(angles[k], &sines[k], &cosines[k]);
    }
}
static Counted NAME(checked_pivot)(Counted value, Counted, int, int *)
{
    ++counts.other;
    return value;
}

#define double Counted
#include FILE_OF_C
#undef double

static void print(const char *name)
{
    printf("%s %ld %ld %ld %ld %ld %ld\n", name, counts.mul, counts.add, counts.div, counts.sqrt, counts.sincos,
           counts.other);
    counts = Counts();
}
