/* What stands before the kernel where it is exported: tables in a buffer of numbers, of which fetch(i) is number i, and
 * what not every language has. languages.c has the types and the other words of src/kernel/one.h. */

/* Four numbers of a table that stand side by side. */
typedef struct quad {
    real x, y, z, w;
} quad;

/* A table: where its rows begin among the numbers, how many cells it has, terms of its law, squarings of its last cell,
 * and the highest power of two <= cells, 2^(steps - 1). */
typedef struct table {
    int at, cells, moments, squarings, highest, steps;
} table;

/* The table whose first number is number `base`. */
KERNEL table table_at(int base)
{
    const table t = {base + VNDF_HEAD,        to_int(fetch(base)),     to_int(fetch(base + 1)),
                     to_int(fetch(base + 2)), to_int(fetch(base + 4)), to_int(fetch(base + 5))};
    return t;
}

/* Numbers i to i + 3, i a multiple of 4: some languages read 16 bytes at once. */
KERNEL quad fetch_4(int i)
{
    const quad row = {fetch(i), fetch(i + 1), fetch(i + 2), fetch(i + 3)};
    return row;
}

/* Row i of a group. */
KERNEL quad load_row(table t, int group, integer i)
{
    return fetch_4(t.at + VNDF_STRIDE * i + 4 * group);
}

/* a < b ? a : b, so b for NaN; and a > b ? a : b. */
KERNEL real min(real a, real b)
{
    return select(lt(a, b), a, b);
}

KERNEL real max(real a, real b)
{
    return select(lt(b, a), a, b);
}

KERNEL integer min_int(integer a, integer b)
{
    if (a < b)
        return a;
    return b;
}

KERNEL integer max_int(integer a, integer b)
{
    if (a > b)
        return a;
    return b;
}

/* Where the law begins for an eighth of an octave of rho: the last knot with a turn below the middle of it. */
KERNEL integer first_knot(table t, integer eighth)
{
    real rho = of_bits(((eighth + VNDF_RHO_FIRST) << 20) + 524288);
    integer first = set_int(0);
    int step = t.highest;
    for (int n = 0; n < t.steps; n++) {
        integer next = min_int(first + step, set_int(t.cells));
        first = select_int(le(load_row(t, VNDF_KNOT, next).w, rho), next, first);
        step = step / 2;
    }
    return first;
}

/* |x| with the sign of y. */
KERNEL real with_sign(real x, real y)
{
    return select(lt(to_real(bits(y)), 0.0f), -abs(x), abs(x));
}
