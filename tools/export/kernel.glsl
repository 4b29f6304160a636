// ---- products ---------------------------------------------------------------------------------------

// The first half of the digits of a.
float vndf_head(float a) {
    float t = 4097.0 * a;
    return t - (t - a);
}

// What the product a b loses where it is rounded (Dekker 1971).
float vndf_product_rest(float a, float b) {
    float c = vndf_head(a);
    float d = vndf_head(b);
    return ((c * d - a * b) + (c * (b - d) + (a - c) * d)) + (a - c) * (b - d);
}

// What a + b loses (Knuth 1969).
float vndf_sum_rest(float a, float b) {
    float sum = a + b;
    float part = sum - a;
    return (a - (sum - part)) + (b - part);
}

// What a . b loses.
float vndf_dot_rest(vec3 a, vec3 b) {
    float x = a.x * b.x;
    float y = a.y * b.y;
    float rest = vndf_product_rest(a.x, b.x) + vndf_product_rest(a.y, b.y) + vndf_product_rest(a.z, b.z);
    return vndf_sum_rest(x, y) + vndf_sum_rest(x + y, a.z * b.z) + rest;
}

// a . b, to which its roundings return where its terms cancel; not by compilers that reorder sums.
float vndf_dot(vec3 a, vec3 b) {
    float x = a.x * b.x;
    float y = a.y * b.y;
    float z = a.z * b.z;
    float sum = x + y + z;
    if (abs(sum) < 0.1 * (abs(x) + abs(y) + abs(z))) {
        return sum + vndf_dot_rest(a, b);
    }
    return sum;
}

// ---- cells ------------------------------------------------------------------------------------------

// A cell of a piecewise density: its densities e0 and e1 at xi = 0 and xi = 1, and its mass m. With eta = 1 - xi and
// k = (e0 + e1)/m the mass before xi is m (xi^2 + e0/m xi eta)/(1 + (k - 2) xi eta) (Gregory & Delbourgo 1982).
struct vndf_cell {
    float e0, e1, mass;
};

// A place between two ends: xi and eta = 1 - xi, each with its digits where it is small.
struct vndf_place {
    float xi, eta;
};

float vndf_pick(bool which, float yes, float no) {
    if (which) {
        return yes;
    }
    return no;
}

// a/b, or 0 where b is not above 0.
float vndf_ratio(float a, float b) {
    if (b > 0.0) {
        return a / b;
    }
    return 0.0;
}

// Mass per unit of xi.
float vndf_cell_density(vndf_cell cell, vndf_place at) {
    float w = at.xi * at.eta;
    float part = vndf_ratio(cell.mass, cell.mass + (cell.e0 + cell.e1 - 2.0 * cell.mass) * w);
    return (cell.e1 * at.xi * at.xi + 2.0 * cell.mass * w + cell.e0 * at.eta * at.eta) * part * part;
}

// The same over xi, where e0 is 0.
float vndf_cell_density_over_xi(vndf_cell cell, vndf_place at) {
    float part = vndf_ratio(cell.mass, cell.mass + (cell.e1 - 2.0 * cell.mass) * at.xi * at.eta);
    return (cell.e1 * at.xi + 2.0 * cell.mass * at.eta) * part * part;
}

// The place with a mass before it: a root that is never a difference of equal numbers.
vndf_place vndf_cell_invert(vndf_cell cell, float before) {
    float e0 = vndf_ratio(cell.e0, cell.mass);
    float e1 = vndf_ratio(cell.e1, cell.mass);
    float t = clamp(vndf_ratio(before, cell.mass), 0.0, 1.0);
    float middle = e0 - t * (e0 + e1);
    float b = middle + 2.0 * t;
    float sum = abs(b) + sqrt(middle * middle + 4.0 * t * (1.0 - t));
    float over = vndf_pick(b >= 0.0, 2.0 * t, sum);
    float under = vndf_pick(b >= 0.0, sum, 2.0 * (1.0 - b));
    return vndf_place(min(vndf_ratio(over, under), 1.0), vndf_pick(under > 0.0, max(under - over, 0.0) / under, 1.0));
}

// ---- tables -----------------------------------------------------------------------------------------

// A wedge is the part of the circle of azimuths that the horizon of wi cuts: behind wi above the horizon, towards wi
// below it. How many cells, spans of rows and pieces it has, and which numbers of the buffer they begin with.
struct vndf_wedge {
    int cells, spans, pieces, q, span, row, piece;
};

// A table: its cells of slopes, their knots, the sums F0 and F1 over all of them, and the slope of its unit roughness.
struct vndf_table {
    int cells, knot, cell;
    float f0, f1, scale;
    vndf_wedge above, below;
};

int vndf_fetch_int(int i) {
    return int(vndf_fetch(i));
}

vndf_wedge vndf_wedge_at(int base, int i) {
    return vndf_wedge(vndf_fetch_int(i), vndf_fetch_int(i + 1), vndf_fetch_int(i + 2), base + vndf_fetch_int(i + 3),
                      base + vndf_fetch_int(i + 4), base + vndf_fetch_int(i + 5), base + vndf_fetch_int(i + 6));
}

// The table whose first number is number `base` of the buffer.
vndf_table vndf_table_at(int base) {
    return vndf_table(vndf_fetch_int(base), base + vndf_fetch_int(base + 1), base + vndf_fetch_int(base + 2),
                      vndf_fetch(base + 3), vndf_fetch(base + 4), vndf_fetch(base + 5),
                      vndf_wedge_at(base, base + 6), vndf_wedge_at(base, base + 13));
}

// The last of `count` ascending numbers, `stride` apart, that is at most x; the first if none is.
int vndf_find(int first, int stride, int count, float x) {
    int i = 0;
    for (int left = count; left > 1; left -= left / 2) {
        if (vndf_fetch(first + (i + left / 2) * stride) <= x) {
            i += left / 2;
        }
    }
    return i;
}

// ---- mass and azimuth of a wedge --------------------------------------------------------------------

// Mass of half a wedge at the coordinate y of the direction: a quintic spline whose Bernstein coefficients ascend, so
// that no term cancels another.
float vndf_wedge_mass(vndf_wedge wedge, float y) {
    int at = wedge.piece + 8 * vndf_find(wedge.piece + 6, 8, wedge.pieces, y);
    float t = clamp((y - vndf_fetch(at + 6)) * vndf_fetch(at + 7), 0.0, 1.0);
    float u = 1.0 - t;
    float inner = u * u * vndf_fetch(at) + (u * t * vndf_fetch(at + 1) + t * t * vndf_fetch(at + 2));
    float outer = u * u * vndf_fetch(at + 3) + (u * t * vndf_fetch(at + 4) + t * t * vndf_fetch(at + 5));
    return u * u * u * inner + t * t * t * outer;
}

// A density over azimuths from 0 to a right angle, (p (1 - q^2), 2 r q) for q from 0 to 1: a mix of three rows of the
// buffer. A row is p, r, the mass before each cell, then density and mass of each cell, and the last density.
struct vndf_row {
    int first, stride;
    float u, v, t, p, r;
};

// Number i of the mix.
float vndf_row_fetch(vndf_row row, int i) {
    int at = row.first + i;
    return row.u * vndf_fetch(at) + row.v * vndf_fetch(at + row.stride) + row.t * vndf_fetch(at + 2 * row.stride);
}

vndf_row vndf_row_of(vndf_wedge wedge, float y) {
    int i = vndf_find(wedge.span, 2, wedge.spans, y);
    int stride = 3 * wedge.cells + 3;
    float m = clamp((y - vndf_fetch(wedge.span + 2 * i)) * vndf_fetch(wedge.span + 2 * i + 1), 0.0, 1.0);
    float rest = 1.0 - m;
    vndf_row row = vndf_row(wedge.row + 2 * i * stride, stride, rest * rest, 2.0 * rest * m, m * m, 0.0, 0.0);
    row.p = vndf_row_fetch(row, 0);
    row.r = vndf_row_fetch(row, 1);
    return row;
}

// Cell j of a row, `width` wide in q.
vndf_cell vndf_row_cell(vndf_wedge wedge, vndf_row row, int j, float width) {
    int at = 2 + wedge.cells + 2 * j;
    return vndf_cell(vndf_row_fetch(row, at) * width, vndf_row_fetch(row, at + 2) * width, vndf_row_fetch(row, at + 1));
}

// An azimuth of the frame in which wi has the azimuth 0: cosine, sine >= 0, and mass per radian.
struct vndf_azimuth {
    float cosine, sine, density;
};

// The azimuth at a place of cell j.
vndf_azimuth vndf_row_azimuth(vndf_wedge wedge, vndf_row row, int j, vndf_place at) {
    float begin = vndf_fetch(wedge.q + j);
    float end = vndf_fetch(wedge.q + j + 1);
    float width = end - begin;
    float q = begin + at.xi * width;
    float x = row.p * ((1.0 - end) + at.eta * width) * (1.0 + q);
    float y = 2.0 * row.r * q;
    float square = x * x + y * y;
    float turned = 2.0 * row.p * row.r * (1.0 + q * q) * width;
    float density = vndf_cell_density(vndf_row_cell(wedge, row, j, width), at) * vndf_ratio(square, turned);
    return vndf_azimuth(vndf_ratio(x, sqrt(square)), vndf_ratio(y, sqrt(square)), density);
}

// The azimuth with the part `part` of the mass before it.
vndf_azimuth vndf_row_draw(vndf_wedge wedge, vndf_row row, float part) {
    int j = 0;
    for (int left = wedge.cells; left > 1; left -= left / 2) {
        if (vndf_row_fetch(row, 2 + j + left / 2) <= part) {
            j += left / 2;
        }
    }
    float width = vndf_fetch(wedge.q + j + 1) - vndf_fetch(wedge.q + j);
    float before = part - vndf_row_fetch(row, 2 + j);
    return vndf_row_azimuth(wedge, row, j, vndf_cell_invert(vndf_row_cell(wedge, row, j, width), before));
}

// The density at an azimuth with a cosine >= 0.
float vndf_row_density(vndf_wedge wedge, vndf_row row, float cosine, float sine) {
    float along = row.r * cosine;
    float aside = row.p * sine;
    float reach = sqrt(along * along + aside * aside);
    float per = vndf_ratio(1.0, (along + reach) * (reach + aside));
    float q = aside * (reach + aside) * per;
    float rest = along * (reach + aside + along) * per; // 1 - q
    int j = vndf_find(wedge.q, 1, wedge.cells, q);
    float begin = vndf_fetch(wedge.q + j);
    float end = vndf_fetch(wedge.q + j + 1);
    float xi = clamp((q - begin) / (end - begin), 0.0, 1.0);
    float eta = clamp((rest - (1.0 - end)) / (end - begin), 0.0, 1.0);
    return vndf_row_azimuth(wedge, row, j, vndf_place(xi, eta)).density;
}

// ---- the azimuth in front of wi ---------------------------------------------------------------------

// In front of a wi above the horizon the density is even + odd cos(a). The mass beyond the azimuth a, where b =
// pi/2 - a and y = sin(b/2).
float vndf_front_beyond(float even, float odd, float y) {
    float y2 = y * y;
    float y4 = y2 * y2;
    float inner = 0.99999998 + 0.16667076 * y2 + y4 * (0.074840751 + 0.046982405 * y2);
    float outer = 0.013773087 + 0.084478642 * y2 + y4 * (-0.10345663 + 0.11751909 * y2);
    return 2.0 * (even * y * (inner + y4 * y4 * outer) + odd * y2);
}

// The azimuth with the mass `rest` beyond it, by Kepler's equation: a start in closed form, and one of Halley's steps.
vndf_azimuth vndf_front_draw(float even, float odd, float rest, float whole) {
    float whole2 = whole * whole;
    float k = (even + 1e-30) * (whole2 + 0.1107 * rest * rest);
    float y = vndf_ratio(rest * whole2, k + sqrt(k * k + 2.0 * odd * (rest * whole2 * whole2)));
    float sine = 2.0 * y * sqrt(max(1.0 - y * y, 0.0));
    float cosine = 1.0 - 2.0 * y * y;
    float density = even + odd * sine + 1e-18;
    float miss = rest - vndf_front_beyond(even, odd, y);
    float turn = miss * density / (density * density + miss * (0.5 * odd * cosine));
    float toward = max((sine + cosine * turn) - sine * (0.5 * turn * turn), 0.0);
    float aside = max((cosine - sine * turn) - cosine * (0.5 * turn * turn), 0.0);
    return vndf_azimuth(toward, aside, even + odd * toward);
}

// ---- the slope at one azimuth -----------------------------------------------------------------------

// The law of the slope X/Z, X + Z = 1, at one azimuth a: P22 R dR times W = c Z + k X, k = s cos(a), where W > 0. The
// cell that holds W = 0 is `cut`, or the number of cells if none does; `part` of it is visible. Its weights are scaled,
// so that the mass of what is seen from deep below the horizon does not vanish.
struct vndf_law {
    float c, k, mass, part;
    int cut;
};

// A cell of the law as far as it is visible, `size` of it from `begin` on. Its density is that of a vndf_cell in xi
// or, if weighted, in zeta with dzeta = 2 V/(v0 + v1) dxi, V = v0 (1 - xi) + v1 xi.
struct vndf_piece {
    vndf_cell cell;
    float v0, v1, begin, size;
    bool weighted;
};

// W at knot j, below 0 where that is hidden.
float vndf_law_weight(vndf_table table, vndf_law law, int j) {
    return law.c * vndf_fetch(table.knot + 8 * j + 1) + law.k * vndf_fetch(table.knot + 8 * j);
}

// Mass before knot j where c >= 0, and beyond it where c < 0: sums of terms that are not negative.
float vndf_law_sum(vndf_table table, vndf_law law, int j) {
    int at = table.knot + 8 * j;
    if (law.c < 0.0) {
        return law.k * vndf_fetch(at + 6) + max(vndf_law_weight(table, law, j), 0.0) * vndf_fetch(at + 7);
    }
    if (law.k < 0.0) {
        return law.c * vndf_fetch(at + 4) + max(vndf_law_weight(table, law, j), 0.0) * vndf_fetch(at + 5);
    }
    return law.c * vndf_fetch(at + 2) + law.k * vndf_fetch(at + 3);
}

// The knot from which such sums are taken for cell j.
int vndf_law_side(vndf_law law, int j) {
    if (law.c < 0.0) {
        return j + 1;
    }
    return j;
}

// The cell of the cut. The cubic of a cell gives its visible mass, at least a thousandth of a straight line's. Below
// the horizon the outer end is visible, and the cubic is turned.
vndf_piece vndf_piece_at_cut(vndf_table table, vndf_law law) {
    int at = table.cell + 7 * law.cut;
    bool above = law.c > 0.0;
    float f0 = vndf_pick(above, vndf_fetch(at), vndf_fetch(at + 1));
    float f1 = vndf_pick(above, vndf_fetch(at + 1), vndf_fetch(at));
    float b = vndf_fetch(at + 6);
    float a = vndf_fetch(at + 5) + vndf_pick(above, 0.0, b);
    float w0 = vndf_law_weight(table, law, law.cut);
    float w1 = vndf_law_weight(table, law, law.cut + 1);
    float w = max(vndf_pick(above, w0, w1), 0.0);
    float hidden = vndf_pick(above, w1, w0);
    float h = vndf_pick(hidden < 0.0, vndf_ratio(w, w - hidden), 1.0);
    b = vndf_pick(above, b, -b);
    float least = 1e-3 * (0.5 * f0 + h * ((f1 - f0) / 6.0));
    float cubic = 0.5 * f0 + h * ((f1 - f0 + a) / 6.0 + h * ((b - a) / 12.0 - h * (0.05 * b)));
    float e0 = f0 * 0.5 * w * h;
    float e1 = max(f0 * (1.0 - h) + f1 * h + h * (1.0 - h) * (a + b * h), 0.0) * 0.5 * w * h;
    float mass = w * h * max(least, cubic);
    if (above) {
        return vndf_piece(vndf_cell(e0, e1, mass), w, 0.0, 0.0, h, true);
    }
    return vndf_piece(vndf_cell(e1, e0, mass), 0.0, w, 1.0 - h, h, true);
}

// Any cell j. Most draw f W in xi. All cells beyond the cut and the two inside it are weighted; the second one inside
// leads from one form to the other.
vndf_piece vndf_piece_of(vndf_table table, vndf_law law, int j) {
    if (j == law.cut) {
        return vndf_piece_at_cut(table, law);
    }
    int at = table.cell + 7 * j;
    float f0 = vndf_fetch(at);
    float f1 = vndf_fetch(at + 1);
    float w0 = max(vndf_law_weight(table, law, j), 0.0);
    float w1 = max(vndf_law_weight(table, law, j + 1), 0.0);
    float mass = w0 * vndf_fetch(at + 2) + w1 * vndf_fetch(at + 3);
    if (j + 2 < law.cut) {
        return vndf_piece(vndf_cell(f0 * w0, f1 * w1, mass), w0, w1, 0.0, 1.0, false);
    }
    float v1 = w1 + vndf_pick(j + 2 == law.cut, min(16.0 * law.part, 1.0) * (w0 - w1), 0.0);
    float mean = 0.5 * (w0 + v1);
    float e1 = f1 * vndf_pick(v1 > 0.0, vndf_ratio(w1, v1), 1.0) * mean;
    return vndf_piece(vndf_cell(f0 * mean, e1, mass), w0, v1, 0.0, 1.0, true);
}

vndf_law vndf_law_of(vndf_table table, float c, float k) {
    float scale = vndf_pick(c < 0.0, 1e18, 1.0);
    vndf_law law = vndf_law(c * scale, k * scale, max(c, 0.0) * table.f0 + max(k, 0.0) * table.f1, 0.0, table.cells);
    if ((c >= 0.0 && k >= 0.0) || !(law.mass > 0.0)) {
        return law;
    }
    law.cut = 0;
    for (int left = table.cells; left > 1; left -= left / 2) {
        if ((vndf_law_weight(table, law, law.cut + left / 2) > 0.0) == (c > 0.0)) {
            law.cut += left / 2;
        }
    }
    vndf_piece piece = vndf_piece_at_cut(table, law);
    law.part = piece.size;
    law.mass = piece.cell.mass + vndf_law_sum(table, law, vndf_law_side(law, law.cut));
    return law;
}

// A slope: its cell and its place there.
struct vndf_slope {
    int cell;
    vndf_place at;
};

float vndf_slope_x(vndf_table table, vndf_slope slope) {
    int at = table.knot + 8 * slope.cell;
    return slope.at.eta * vndf_fetch(at) + slope.at.xi * vndf_fetch(at + 8);
}

float vndf_slope_z(vndf_table table, vndf_slope slope) {
    int at = table.knot + 8 * slope.cell;
    return slope.at.eta * vndf_fetch(at + 1) + slope.at.xi * vndf_fetch(at + 9);
}

// The slope X/Z.
vndf_slope vndf_slope_of(vndf_table table, float x, float z) {
    int cell = 0;
    for (int left = table.cells; left > 1; left -= left / 2) {
        int at = table.knot + 8 * (cell + left / 2);
        if (x * vndf_fetch(at + 1) >= z * vndf_fetch(at)) {
            cell += left / 2;
        }
    }
    int knot = table.knot + 8 * cell;
    float inner = max(x * vndf_fetch(knot + 1) - z * vndf_fetch(knot), 0.0);
    float outer = max(z * vndf_fetch(knot + 8) - x * vndf_fetch(knot + 9), 0.0);
    float whole = inner + outer;
    return vndf_slope(cell, vndf_place(vndf_ratio(inner, whole), vndf_pick(whole > 0.0, vndf_ratio(outer, whole), 1.0)));
}

// The place in a piece from the place in its cell.
vndf_place vndf_piece_place(vndf_piece piece, vndf_place zeta) {
    if (!piece.weighted) {
        return zeta;
    }
    float v = sqrt(piece.v0 * piece.v0 * zeta.eta + piece.v1 * piece.v1 * zeta.xi);
    float xi = zeta.xi * (piece.v1 + v);
    float eta = zeta.eta * (piece.v0 + v);
    if (!(xi + eta > 0.0)) {
        xi = zeta.xi;
        eta = zeta.eta;
    }
    float per = piece.size / (xi + eta);
    float hidden = vndf_pick(piece.begin > 0.0, 0.0, 1.0 - piece.size);
    return vndf_place(piece.begin + xi * per, hidden + eta * per);
}

// The cell in which the mass `goal` ends: before a place where c >= 0, beyond it where c < 0.
int vndf_law_find(vndf_table table, vndf_law law, float goal) {
    bool above = law.c >= 0.0;
    int cell = 0;
    int end = table.cells;
    if (above && law.cut < end) {
        end = law.cut + 1;
    } else if (law.cut < end) {
        cell = law.cut;
    }
    for (int left = end - cell; left > 1; left -= left / 2) {
        float sum = vndf_law_sum(table, law, cell + left / 2);
        if ((above && sum <= goal) || (!above && sum > goal)) {
            cell += left / 2;
        }
    }
    return cell;
}

// The place in cell j, which is `piece`, with that mass before or beyond it.
vndf_place vndf_law_draw(vndf_table table, vndf_law law, int j, vndf_piece piece, float goal) {
    float rest = goal - vndf_law_sum(table, law, vndf_law_side(law, j));
    return vndf_piece_place(piece, vndf_cell_invert(piece.cell, vndf_pick(law.c >= 0.0, rest, piece.cell.mass - rest)));
}

// The density of a slope per X Z^2 dR, whose cell is `piece`; the weight W of the normal, before scaling, is w.
float vndf_law_density(vndf_table table, vndf_law law, vndf_slope slope, vndf_piece piece, float w) {
    float xi = slope.at.xi;
    float eta = slope.at.eta;
    float per = vndf_ratio(vndf_ratio(1.0, piece.size), law.mass);
    float zeta_per_xi = 1.0;
    if (piece.size < 1.0) {
        xi = min(vndf_ratio(xi, piece.size), 1.0);
        eta = min(vndf_ratio(eta, piece.size), 1.0);
        xi = vndf_pick(piece.begin > 0.0, 1.0 - eta, xi);
        eta = vndf_pick(piece.begin > 0.0, eta, 1.0 - xi);
    }
    if (piece.weighted) {
        float both = vndf_ratio(1.0, piece.v0 + piece.v1);
        float v = piece.v0 * eta + piece.v1 * xi;
        zeta_per_xi = (piece.v0 + v) * both;
        xi = xi * zeta_per_xi;
        eta = eta * ((v + piece.v1) * both);
        per = per * 2.0 * vndf_pick(law.c < 0.0, w * 1e18, vndf_pick(piece.size < 1.0, w, v)) * both;
    }
    float x = vndf_slope_x(table, slope);
    float sum = x + vndf_slope_z(table, slope);
    per = per * sum * sum * sum / vndf_fetch(table.cell + 7 * slope.cell + 4);
    if (slope.cell == 0 && piece.cell.e0 == 0.0) {
        float over_xi = vndf_cell_density_over_xi(piece.cell, vndf_place(xi, eta));
        return per * zeta_per_xi * over_xi / (piece.size * vndf_fetch(table.knot + 8));
    }
    return vndf_ratio(per * vndf_cell_density(piece.cell, vndf_place(xi, eta)), x);
}

// The slope, or the cut where rounding took it beyond.
vndf_slope vndf_slope_seen(vndf_table table, vndf_law law, vndf_slope slope) {
    bool above = law.c > 0.0;
    if (law.cut == table.cells || (above && slope.cell <= law.cut) || (!above && slope.cell >= law.cut)) {
        return slope;
    }
    float xi = vndf_pick(above, law.part, 1.0 - law.part);
    return vndf_slope(law.cut, vndf_place(xi, 1.0 - xi));
}

// P22/Z^4 at a slope, X + Z = 1. In the first cell f begins at 0 as X does.
float vndf_slope_p22(vndf_table table, vndf_slope slope) {
    int at = table.cell + 7 * slope.cell;
    float rise = vndf_fetch(at + 1) + slope.at.eta * (vndf_fetch(at + 5) + vndf_fetch(at + 6) * slope.at.xi);
    float x = vndf_slope_x(table, slope);
    float sum = x + vndf_slope_z(table, slope);
    float f = vndf_fetch(at) * slope.at.eta + slope.at.xi * rise;
    if (slope.cell == 0) {
        f = rise;
        x = vndf_fetch(table.knot + 8);
    }
    return max(f, 0.0) * (sum * sum) * (sum * sum) / (x * vndf_fetch(at + 4));
}

// ---- GGX and Beckmann -------------------------------------------------------------------------------

// Both at unit roughness, for a direction (s, 0, c) of unit length on either side of the horizon.

// 1 + c without a difference.
float vndf_ggx_cap(float s, float c) {
    return vndf_pick(c < 0.0, s * s / (1.0 + abs(c)), 1.0 + c);
}

// N with sqrt(pi) exp(z^2) erfc(z) = 1/(z + N), z >= 0.
float vndf_erfc_rest(float z) {
    float z2 = z * z;
    float even_over = 0.564189583 + z2 * (0.434423688 + z2 * 0.0355887364);
    float odd_over = 0.699703836 + z2 * (0.161049457 + z2 * 0.00390720607);
    float even_under = 1.0 + z2 * (1.71036832 + z2 * (0.329914265 + z2 * 0.00781441218));
    float odd_under = 1.88426723 + z2 * (0.939992107 + z2 * 0.0711774627);
    return (even_over + z * odd_over) / (even_under + z * odd_under);
}

// y with (1 + erf y)/2 = u: a start in closed form, and two of Newton's steps.
float vndf_erf_quantile(float u) {
    float tail = clamp(min(u, 1.0 - u), 1e-30, 0.5);
    float w = log(4.0 * tail * (1.0 - tail));
    float b = 4.33074675 + 0.5 * w;
    float z = sqrt(max(sqrt(b * b - w / 0.147) - b, 0.0));
    for (int i = 0; i < 2; i += 1) {
        float rate = z + vndf_erfc_rest(z);
        z = max(z + (0.282094792 * exp(-z * z) / (rate * tail) - 1.0) / (2.0 * rate), 0.0);
    }
    return vndf_pick(u < 0.5, -z, z);
}

float vndf_log_one_plus(float x) {
    float rounded = (1.0 + x) - 1.0;
    if (rounded > 0.0) {
        return log(1.0 + x) * (x / rounded);
    }
    return x;
}

// The law of the slope x along the direction, with the density d exp(-x^2), d = bound - x > 0: its mass `whole` in
// units of s/(2 sqrt(pi)), of which `rise` is for x > 0 alone. Where bound < 5/4 both are over exp(-bound^2).
struct vndf_beckmann_law {
    float bound, rise, whole;
};

vndf_beckmann_law vndf_beckmann_of(float s, float c) {
    float bound = c / max(s, 1e-7);
    float rest = vndf_erfc_rest(abs(bound));
    float part = rest / (rest + abs(bound));
    float gauss = exp(-min(bound * bound, 80.0));
    float rise = 3.54490770 * max(bound, 0.0);
    if (bound < 1.25) {
        return vndf_beckmann_law(bound, rise / gauss, rise / gauss + part);
    }
    return vndf_beckmann_law(bound, rise, rise + part * gauss);
}

// The exponent of its density at x = bound - d.
float vndf_beckmann_exponent(vndf_beckmann_law law, float x, float d) {
    return vndf_pick(law.bound < 1.25, d * (d - 2.0 * law.bound), x * x);
}

// A slope x and its distance d = bound - x: each with its own digits, since d is tiny or x far below the bound.
struct vndf_beckmann_slope {
    float x, d;
};

// The slope to begin with for the part u of the mass.
vndf_beckmann_slope vndf_beckmann_start(vndf_beckmann_law law, float u) {
    float rho2 = -log(u);
    float m = sqrt(law.whole * rho2);
    float d = 0.0;
    if (law.bound <= 0.0) {
        float b = sqrt(0.055 + 0.865 * law.whole);
        float more = rho2 - 2.0 * law.bound * m / (1.0 + b * sqrt(rho2));
        d = more / (sqrt(law.bound * law.bound + more) - law.bound);
        return vndf_beckmann_slope(law.bound - d, d);
    }
    if (law.bound < 1.25) {
        d = m * (1.0 + 0.8 * sqrt(rho2)) / (1.0 + 0.8 * m);
        return vndf_beckmann_slope(law.bound - d, d);
    }
    float h = 0.5 / law.bound;
    float q = vndf_erf_quantile(min(u * law.whole / law.rise, 0.9999999)) - h;
    float e = 1.0 + 0.7 * h * abs(q);
    float x = q * e / (e + h * h);
    d = law.bound - x;
    if (d < 0.7 && law.bound < 6.0) {
        float l = vndf_log_one_plus(law.bound * m * exp(0.5 * law.bound * law.bound) / 1.5);
        d = 1.5 / law.bound * l * (1.0 - vndf_log_one_plus(l) / (2.0 + l));
        x = law.bound - d;
    }
    return vndf_beckmann_slope(x, d);
}

// Three of Householder's steps of order four, held inside the law.
vndf_beckmann_slope vndf_beckmann_invert(vndf_beckmann_law law, float part) {
    float u = clamp(part, 1e-19, 0.99999994);
    vndf_beckmann_slope slope = vndf_beckmann_start(law, u);
    for (int i = 0; i < 3; i += 1) {
        float x = slope.x;
        float d = slope.d;
        float rest = vndf_erfc_rest(abs(x));
        float right = vndf_pick(x > 0.0, 1.0, 0.0);
        float have = (rest + d * (1.0 - 2.0 * right)) / (rest + abs(x));
        float want = (u * law.whole - right * law.rise) * exp(vndf_beckmann_exponent(law, x, d));
        float h = (have - want) / (2.0 * d);
        float second = -1.0 / d - 2.0 * x;
        float third = 4.0 * x * (1.0 / d + x) - 2.0;
        float under = 1.0 + h * (h * third / 6.0 - second);
        float shift = vndf_pick(under > 0.0, vndf_ratio(h * (1.0 - 0.5 * h * second), under), h);
        float change = clamp(shift, -0.5 * d, 1.0);
        slope.x = x - change;
        slope.d = d + change;
    }
    return slope;
}

// ---- surfaces and views -----------------------------------------------------------------------------

// A surface whose slopes (-wm.x/wm.z, -wm.y/wm.z) are (xx xy; yx yy) u + mean, where u are slopes of the distribution:
// the first number of a table, VNDF_GGX or VNDF_BECKMANN.
struct vndf_surface {
    int distribution;
    float xx, xy, yx, yy, mean_x, mean_y;
};

// The surface with roughness alpha_x and alpha_y along x and y.
vndf_surface vndf_surface_of(int distribution, float alpha_x, float alpha_y) {
    return vndf_surface(distribution, alpha_x, 0.0, 0.0, alpha_y, 0.0, 0.0);
}

// A surface seen from wi. (s, 0, c) is the direction in which its distribution is seen at unit roughness, turned and
// divided by `size`; `front` and `wedge` are masses of half a turn, `area` is the projected area of that direction.
struct vndf_view {
    vndf_surface surface;
    vec3 wi;
    float cos_phi, sin_phi, s, c, size, front, wedge, area;
};

// The determinant of the matrix, without its sign.
float vndf_determinant(vndf_surface surface) {
    return abs(surface.xx * surface.yy - surface.xy * surface.yx);
}

// The surface in units of its table.
vndf_surface vndf_surface_scaled(vndf_surface surface) {
    float scale = 1.0;
    if (surface.distribution >= 0) {
        scale = vndf_fetch(surface.distribution + 5);
    }
    return vndf_surface(surface.distribution, surface.xx * scale, surface.xy * scale, surface.yx * scale,
                        surface.yy * scale, surface.mean_x, surface.mean_y);
}

// The projection of a direction on the mean plane: w.z where there is no mean slope.
float vndf_cosine(vndf_surface surface, vec3 w) {
    if (surface.mean_x == 0.0 && surface.mean_y == 0.0) {
        return w.z;
    }
    return vndf_dot(vec3(-surface.mean_x, -surface.mean_y, 1.0), w);
}

// wi is unit, and may be below the surface.
vndf_view vndf_view_of(vndf_surface surface, vec3 wi) {
    vndf_surface scaled = vndf_surface_scaled(surface);
    float x = scaled.xx * wi.x;
    float y = scaled.yy * wi.y;
    if (scaled.xy != 0.0 || scaled.yx != 0.0) {
        x = vndf_dot(vec3(scaled.xx, scaled.yx, 0.0), wi);
        y = vndf_dot(vec3(scaled.xy, scaled.yy, 0.0), wi);
    }
    float z = vndf_cosine(surface, wi);
    float aside = sqrt(x * x + y * y);
    float across = max(aside, 1e-9 * abs(z)); // straight from below nothing would be visible
    float size = vndf_pick(surface.distribution >= 0, across + abs(z), sqrt(across * across + z * z));
    float s = across / size;
    float c = z / size;
    float front = 0.0;
    float wedge = 1.0;
    float area = 0.5 * vndf_ggx_cap(s, c);
    if (surface.distribution == VNDF_BECKMANN) {
        vndf_beckmann_law law = vndf_beckmann_of(s, c);
        float falloff = vndf_pick(law.bound < 1.25, exp(-min(law.bound * law.bound, 80.0)), 1.0);
        area = 0.282094792 * max(s, 1e-7) * law.whole * falloff;
    } else if (surface.distribution >= 0) {
        vndf_table table = vndf_table_at(surface.distribution);
        if (c >= 0.0) {
            front = c * table.f0 * 1.57079633 + s * table.f1;
            wedge = vndf_wedge_mass(table.above, c);
            area = 2.0 * (front + wedge);
        } else {
            area = 2.0 * vndf_wedge_mass(table.below, s);
        }
    }
    float cos_phi = vndf_pick(aside > 0.0, vndf_ratio(x, aside), 1.0);
    return vndf_view(scaled, wi, cos_phi, vndf_ratio(y, aside), s, c, size, front, wedge, area);
}

// ---- given normals ----------------------------------------------------------------------------------

// The normal at unit roughness, turned if the view is; of any length, its z is wm.z.
vec3 vndf_unit_normal(vndf_surface m, vec3 wm, float cos_phi, float sin_phi) {
    float x = wm.x;
    float y = wm.y;
    if (m.mean_x != 0.0 || m.mean_y != 0.0) {
        x = vndf_dot(vec3(1.0, 0.0, m.mean_x), wm);
        y = vndf_dot(vec3(0.0, 1.0, m.mean_y), wm);
    }
    float per = 1.0 / (m.xx * m.yy - m.xy * m.yx);
    float a = (m.yy * x - m.xy * y) * per;
    float b = (m.xx * y - m.yx * x) * per;
    return vec3(cos_phi * a + sin_phi * b, cos_phi * b - sin_phi * a, wm.z);
}

// D of the scaled surface at that normal.
float vndf_unit_ndf(vndf_surface surface, vec3 n) {
    float determinant = vndf_determinant(surface);
    float x2 = n.x * n.x + n.y * n.y;
    float z2 = n.z * n.z;
    if (surface.distribution == VNDF_GGX) {
        return vndf_ratio(0.318309886, (x2 + z2) * (x2 + z2) * determinant);
    }
    if (surface.distribution == VNDF_BECKMANN) {
        return vndf_ratio(0.318309886 * exp(-vndf_ratio(x2, z2)), z2 * z2 * determinant);
    }
    vndf_table table = vndf_table_at(surface.distribution);
    float sum = sqrt(x2) + n.z;
    float p22 = vndf_slope_p22(table, vndf_slope_of(table, sqrt(x2) / sum, n.z / sum));
    return p22 / (sum * sum * (sum * sum) * determinant);
}

// D(wm) per steradian; wm is unit, here and below.
float vndf_ndf(vndf_surface surface, vec3 wm) {
    vndf_surface scaled = vndf_surface_scaled(surface);
    if (wm.z < 0.0) {
        return 0.0;
    }
    return vndf_unit_ndf(scaled, vndf_unit_normal(scaled, wm, 1.0, 0.0));
}

float vndf_table_pdf(vndf_view view, vec3 n, float facing) {
    vndf_table table = vndf_table_at(view.surface.distribution);
    float x = sqrt(n.x * n.x + n.y * n.y);
    float cosine = vndf_pick(x > 0.0, vndf_ratio(n.x, x), 1.0);
    float sine = vndf_ratio(abs(n.y), x);
    float density = 0.5 / (view.front + view.wedge);
    if (view.c < 0.0) {
        density = density * vndf_row_density(table.below, vndf_row_of(table.below, view.s), max(cosine, 0.0), sine);
    } else if (cosine >= 0.0) {
        density = density * (view.c * table.f0 + view.s * table.f1 * cosine);
    } else {
        vndf_row row = vndf_row_of(table.above, view.c);
        density = density * view.wedge * vndf_row_density(table.above, row, -cosine, sine);
    }
    vndf_law law = vndf_law_of(table, view.c, view.s * cosine);
    float scale = 1.0 / (x + n.z);
    vndf_slope slope = vndf_slope_seen(table, law, vndf_slope_of(table, x * scale, n.z * scale));
    vndf_piece piece = vndf_piece_of(table, law, slope.cell);
    density = density * vndf_law_density(table, law, slope, piece, facing * scale / view.size);
    return density * (scale * scale) * (scale / vndf_determinant(view.surface));
}

float vndf_facing(vndf_view view, vec3 wm) {
    return vndf_dot(view.wi, wm);
}

// The area of the surface as it is seen from wi.
float vndf_projected_area(vndf_view view) {
    return view.area * view.size;
}

// The visible normals D(wm) (wi . wm)/A(wi), from which a table differs by what it states.
float vndf_visible(vndf_view view, vec3 wm) {
    float facing = vndf_facing(view, wm);
    if (!(facing > 0.0) || wm.z < 0.0) {
        return 0.0;
    }
    vec3 n = vndf_unit_normal(view.surface, wm, view.cos_phi, view.sin_phi);
    return vndf_ratio(vndf_unit_ndf(view.surface, n) * facing, vndf_projected_area(view));
}

// A density on the rim of a lobe may leave the range of floats.
float vndf_finite(float density) {
    return clamp(density, 1.2e-38, 3.4e38);
}

// The density with which vndf_sample draws wm.
float vndf_pdf(vndf_view view, vec3 wm) {
    float facing = vndf_facing(view, wm);
    if (!(facing > 0.0) || wm.z < 0.0) {
        return 0.0;
    }
    if (view.surface.distribution == VNDF_GGX) {
        return vndf_finite(vndf_visible(view, wm));
    }
    vec3 n = vndf_unit_normal(view.surface, wm, view.cos_phi, view.sin_phi);
    if (view.surface.distribution >= 0) {
        return vndf_finite(vndf_table_pdf(view, n, facing));
    }
    vndf_beckmann_law law = vndf_beckmann_of(view.s, view.c);
    float d = vndf_ratio(facing / view.size, n.z * max(view.s, 1e-7));
    float x = vndf_ratio(-n.x, n.z);
    float y = vndf_ratio(n.y, n.z);
    float density = 1.12837917 * exp(-vndf_beckmann_exponent(law, x, d) - y * y) * d / law.whole;
    return vndf_finite(vndf_ratio(density, n.z * n.z * n.z * vndf_determinant(view.surface)));
}

// ---- sampling ---------------------------------------------------------------------------------------

// A normal, and the density per steradian with which it is drawn.
struct vndf_sampled {
    vec3 wm;
    float pdf;
};

// A normal at unit roughness as it is drawn, turned and of any length: `density` is that of its direction over |n|^3, and
// w = n . (s, 0, c).
struct vndf_drawn {
    vec3 n;
    float density, w;
};

// By what the rounding of wm moves D where mean slopes are far beyond the roughness.
float vndf_leaning(vndf_surface m, vec3 n, float reach, vec3 wm) {
    if (m.mean_x * m.mean_x + m.mean_y * m.mean_y < 16.0 * vndf_determinant(m)) {
        return 1.0;
    }
    float drawn = vndf_unit_ndf(m, vec3(n.x / reach, n.y / reach, n.z / reach));
    float rounded = vndf_unit_ndf(m, vndf_unit_normal(m, wm, 1.0, 0.0));
    return vndf_pick(drawn > 0.0, vndf_ratio(rounded, drawn), 1.0);
}

// Where rounding turns the normal away from wi, it is turned back.
vndf_sampled vndf_sampled_at(vndf_view view, vndf_drawn drawn) {
    vec3 n = drawn.n;
    vndf_surface m = view.surface;
    float a = view.cos_phi * n.x - view.sin_phi * n.y;
    float b = view.sin_phi * n.x + view.cos_phi * n.y;
    float x = m.xx * a + m.xy * b - m.mean_x * n.z;
    float y = m.yx * a + m.yy * b - m.mean_y * n.z;
    float reach = sqrt(x * x + y * y + n.z * n.z);
    float facing = view.wi.x * x + view.wi.y * y + view.wi.z * n.z;
    float lift = max(2e-7 * reach - facing, 0.0);
    vec3 wm = vec3((x + lift * view.wi.x) / reach, (y + lift * view.wi.y) / reach,
                   max((n.z + lift * view.wi.z) / reach, 0.0));
    float moved = vndf_leaning(m, n, reach, wm);
    if (view.c < 0.0) { // next to the rim, where the rounding of wm moves w
        moved = moved * vndf_ratio(max(vndf_dot(view.wi, wm), 1e-8) * reach, view.size * drawn.w);
    }
    return vndf_sampled(wm, vndf_finite(drawn.density * moved * (reach * reach) * (reach / vndf_determinant(m))));
}

// The azimuth with the part `part` of half a turn's mass between the side of wi and it; its density is of the whole
// turn.
vndf_azimuth vndf_view_azimuth(vndf_view view, vndf_table table, float part) {
    float total = view.front + view.wedge;
    float goal = part * total;
    float even = view.c * table.f0;
    vndf_azimuth drawn = vndf_azimuth(1.0, 0.0, 0.0);
    if (view.c < 0.0) {
        drawn = vndf_row_draw(table.below, vndf_row_of(table.below, view.s), part);
        drawn.cosine = max(drawn.cosine, 1e-7);
    } else if (goal < view.front || !(view.wedge > 0.0)) {
        drawn = vndf_front_draw(even, view.s * table.f1, max(view.front - goal, 0.0), view.front);
    } else {
        float rest = clamp(1.0 - (goal - view.front) / view.wedge, 0.0, 1.0);
        drawn = vndf_row_draw(table.above, vndf_row_of(table.above, view.c), rest);
        drawn.cosine = -drawn.cosine;
        drawn.density = drawn.density * view.wedge;
    }
    drawn.density = drawn.density * 0.5 / total;
    return drawn;
}

vndf_drawn vndf_table_draw(vndf_view view, float u1, float u2) {
    vndf_table table = vndf_table_at(view.surface.distribution);
    float side = 2.0 * u1 - 1.0;
    vndf_azimuth azimuth = vndf_view_azimuth(view, table, abs(side));
    float k = view.s * azimuth.cosine;
    vndf_law law = vndf_law_of(table, view.c, k);
    float goal = law.mass * vndf_pick(view.c >= 0.0, u2, 1.0 - u2);
    int cell = vndf_law_find(table, law, goal);
    vndf_piece piece = vndf_piece_of(table, law, cell);
    vndf_slope slope = vndf_slope(cell, vndf_law_draw(table, law, cell, piece, goal));
    float x = vndf_slope_x(table, slope);
    float z = vndf_slope_z(table, slope);
    float least = 1e-7 * (abs(view.c) * z + abs(k) * x);
    float w = max(view.c * z + k * x, least);
    float density = azimuth.density * vndf_law_density(table, law, slope, piece, w);
    float y = x * vndf_pick(side < 0.0, -azimuth.sine, azimuth.sine);
    return vndf_drawn(vec3(x * azimuth.cosine, y, z), density, w);
}

// The sum of the direction and of a point on the cap of the sphere that is visible (Dupuy & Benyoub 2023).
vndf_drawn vndf_ggx_draw(vndf_view view, float u1, float u2) {
    float s2 = view.s * view.s;
    float cap = vndf_ggx_cap(view.s, view.c);
    float v = 1.0 - u2;
    float t = sqrt(u2 * (s2 + v * cap * cap));
    float sine = sin(3.14159265 * u1);
    float cosine = cos(3.14159265 * u1);
    float unit = 1.0 / sqrt(sine * sine + cosine * cosine); // some processors round them by 5e-4
    float along = vndf_ratio(v * (s2 - u2 * cap * cap), view.s + t) + 2.0 * t * (sine * unit) * (sine * unit);
    vec3 n = vec3(along, -2.0 * t * (sine * unit) * (cosine * unit), v * cap);
    float square = n.x * n.x + n.y * n.y + n.z * n.z;
    return vndf_drawn(n, vndf_ratio(0.159154943, view.area * square), 0.5 * square);
}

vndf_drawn vndf_beckmann_draw(vndf_view view, float u1, float u2) {
    vndf_beckmann_law law = vndf_beckmann_of(view.s, view.c);
    vndf_beckmann_slope slope = vndf_beckmann_invert(law, u1);
    float y = vndf_erf_quantile(clamp(u2, 1e-19, 0.99999994));
    float density = 1.12837917 * exp(-vndf_beckmann_exponent(law, slope.x, slope.d) - y * y) * slope.d / law.whole;
    return vndf_drawn(vec3(-slope.x, -y, 1.0), density, max(view.s, 1e-7) * slope.d);
}

// Draws a visible normal with two uniform numbers in [0, 1].
vndf_sampled vndf_sample(vndf_view view, float u1, float u2) {
    vndf_drawn drawn;
    if (view.surface.distribution == VNDF_GGX) {
        drawn = vndf_ggx_draw(view, u1, min(u2, 0.99999994));
    } else if (view.surface.distribution == VNDF_BECKMANN) {
        drawn = vndf_beckmann_draw(view, u1, u2);
    } else {
        drawn = vndf_table_draw(view, u1, u2);
    }
    return vndf_sampled_at(view, drawn);
}

// ---- masking ----------------------------------------------------------------------------------------

// Lambda(w) = A(w)/cos - 1, where cos is vndf_cosine; -1 - Lambda(-w) below the surface.
float vndf_lambda(vndf_surface surface, vec3 w) {
    float up = vndf_cosine(surface, w);
    float side = vndf_pick(up < 0.0, 1.0, -1.0);
    vndf_view behind = vndf_view_of(surface, vec3(side * w.x, side * w.y, side * w.z));
    float lambda = min(vndf_projected_area(behind) / max(abs(up), 1e-30), 1e30);
    return vndf_pick(up < 0.0, -1.0 - lambda, lambda);
}

float vndf_g1(vndf_surface surface, vec3 w) {
    return vndf_pick(vndf_cosine(surface, w) > 0.0, 1.0 / (1.0 + max(vndf_lambda(surface, w), 0.0)), 0.0);
}

// Masking and shadowing of two directions on the same side, height-correlated.
float vndf_g2(vndf_surface surface, vec3 wi, vec3 wo) {
    if (!(vndf_cosine(surface, wi) > 0.0) || !(vndf_cosine(surface, wo) > 0.0)) {
        return 0.0;
    }
    return 1.0 / (1.0 + vndf_lambda(surface, wi) + vndf_lambda(surface, wo));
}

// ---- several lobes on one surface -------------------------------------------------------------------

// Up to VNDF_LOBES surfaces with weights that need no sum.
struct vndf_mixture {
    int count;
    vndf_surface lobe[VNDF_LOBES];
    float weight[VNDF_LOBES];
};

// Seen from wi: each lobe has a share of the visible area.
struct vndf_mixture_view {
    int count;
    vndf_view lobe[VNDF_LOBES];
    float share[VNDF_LOBES];
    float area;
};

// Copies, here and below, since some languages index no parameter.
vndf_mixture_view vndf_mixture_view_of(vndf_mixture mixture, vec3 wi) {
    vndf_mixture lobes = mixture;
    vndf_mixture_view view;
    float weight = 0.0;
    view.count = lobes.count;
    view.area = 0.0;
    for (int i = 0; i < lobes.count; i += 1) {
        view.lobe[i] = vndf_view_of(lobes.lobe[i], wi);
        view.share[i] = lobes.weight[i] * vndf_projected_area(view.lobe[i]);
        view.area = view.area + view.share[i];
        weight = weight + lobes.weight[i];
    }
    for (int j = 0; j < lobes.count; j += 1) {
        view.share[j] = vndf_ratio(view.share[j], view.area);
    }
    view.area = vndf_ratio(view.area, weight);
    return view;
}

float vndf_mixture_pdf(vndf_mixture_view view, vec3 wm) {
    vndf_mixture_view lobes = view;
    float density = 0.0;
    for (int i = 0; i < lobes.count; i += 1) {
        density = density + lobes.share[i] * vndf_pdf(lobes.lobe[i], wm);
    }
    return density;
}

float vndf_mixture_visible(vndf_mixture_view view, vec3 wm) {
    vndf_mixture_view lobes = view;
    float density = 0.0;
    for (int i = 0; i < lobes.count; i += 1) {
        density = density + lobes.share[i] * vndf_visible(lobes.lobe[i], wm);
    }
    return density;
}

// u1 says which lobe is drawn, and its part of 1 is stretched to [0, 1]; the density is that of the whole.
vndf_sampled vndf_mixture_sample(vndf_mixture_view view, float u1, float u2) {
    vndf_mixture_view lobes = view;
    float before = 0.0;
    int drawn = 0;
    for (int i = 0; i + 1 < lobes.count; i += 1) {
        if (drawn == i && u1 >= before + lobes.share[i]) {
            before = before + lobes.share[i];
            drawn = i + 1;
        }
    }
    float u = clamp(vndf_ratio(u1 - before, lobes.share[drawn]), 0.0, 1.0);
    vndf_sampled sampled = vndf_sample(lobes.lobe[drawn], u, u2);
    float density = lobes.share[drawn] * sampled.pdf;
    for (int j = 0; j < lobes.count; j += 1) {
        if (j != drawn) {
            density = density + lobes.share[j] * vndf_pdf(lobes.lobe[j], sampled.wm);
        }
    }
    return vndf_sampled(sampled.wm, density);
}

float vndf_mixture_ndf(vndf_mixture mixture, vec3 wm) {
    vndf_mixture lobes = mixture;
    float weight = 0.0;
    float density = 0.0;
    for (int i = 0; i < lobes.count; i += 1) {
        weight = weight + lobes.weight[i];
        density = density + lobes.weight[i] * vndf_ndf(lobes.lobe[i], wm);
    }
    return vndf_ratio(density, weight);
}
