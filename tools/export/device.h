/* What stands before the kernel where it is exported: tables in a buffer of numbers, of which fetch(i) is number i, and
 * what not every language has. languages.c has the types and the other words of src/kernel/one.h. */

/* Four numbers of a table that stand side by side. */
typedef struct quad {
    real a, b, c, d;
} quad;

/* A table: where its rows begin among the numbers, how many cells it has, terms of its law, squarings of its last cell,
 * and the highest power of two <= cells, 2^(steps - 1). */
typedef struct table {
    int at, cells, moments, squarings, highest, steps;
} table;

enum { HEAD = 8 };
enum { VNDF_KNOT = 0, VNDF_LAW = 1, VNDF_MORE = 2, VNDF_TAIL = 3, VNDF_LOW = 4 };

/* The table whose first number is number `base`. */
HERE table table_at(int base)
{
    const table t = {base + HEAD,
                     to_whole(fetch(base)),
                     to_whole(fetch(base + 1)),
                     to_whole(fetch(base + 2)),
                     to_whole(fetch(base + 4)),
                     to_whole(fetch(base + 5))};
    return t;
}

/* Row i of a group. */
HERE quad look(table t, int group, whole i)
{
    const int at = t.at + 20 * i + 4 * group;
    const quad row = {fetch(at), fetch(at + 1), fetch(at + 2), fetch(at + 3)};
    return row;
}

/* a < b ? a : b, so b for NaN; and a > b ? a : b. */
HERE real least(real a, real b)
{
    return pick(less(a, b), a, b);
}

HERE real most(real a, real b)
{
    return pick(less(b, a), a, b);
}

HERE whole least_whole(whole a, whole b)
{
    if (a < b)
        return a;
    return b;
}

HERE whole most_whole(whole a, whole b)
{
    if (a > b)
        return a;
    return b;
}

enum { VNDF_RHO_PARTS = 224, VNDF_RHO_FIRST = 912 }; /* of table/table.h */

/* Where the law begins for an eighth of an octave of rho: the last knot with a turn below the middle of it. */
HERE whole look_first(table t, whole eighth)
{
    real rho = of_bits(((eighth + VNDF_RHO_FIRST) << 20) + 524288);
    whole first = set_whole(0);
    int step = t.highest;
    for (int n = 0; n < t.steps; n++) {
        whole next = least_whole(first + step, set_whole(t.cells));
        first = pick_whole(at_most(look(t, VNDF_KNOT, next).d, rho), next, first);
        step = step / 2;
    }
    return first;
}

/* |x| with the sign of y. */
HERE real with_sign(real x, real y)
{
    return pick(less(to_real(bits(y)), 0.0f), -size(x), size(x));
}
