/* Each of the three profiles resolves its P22 on panels of its own; on all their edges together all three are
 * resolved, whatever moves between them. A change of sign inside a panel costs little: the sum is that of a
 * function that is continuous there. */
#include "fit/family/distance.h"

#include <math.h>
#include <stdlib.h>

#include "core/error.h"
#include "fit/family/pattern.h"
#include "fit/profile/profile.h"
#include "math/ascending.h"

static const double PI = 3.14159265358979323846;

vndf_status vndf_member_open(vndf_member *member, const char *pattern, double p, vndf_error *error)
{
    vndf_guard guard = vndf_guard_from(NULL, NULL);
    vndf_error inner = {VNDF_OK, ""};
    member->p = p;
    member->source = vndf_pattern_source(pattern, p, &inner);
    member->profile = member->source ? vndf_profile_from(member->source, NULL, &guard, &inner) : NULL;
    if (member->profile) {
        member->profile->guard = NULL;
        return VNDF_OK;
    }
    vndf_member_close(member);
    return vndf_fail(error, inner.status, "at the parameter %.7g: %s", p, inner.message);
}

void vndf_member_close(vndf_member *member)
{
    vndf_profile_free(member->profile);
    vndf_source_free(member->source);
    member->profile = NULL;
    member->source = NULL;
}

/* P22 at a slope in the source's unit, and the integral of P22 r^2 dr. */
static double p22(const vndf_member *member, double r)
{
    return member->profile->normalization * vndf_source_p22(member->source, r);
}

static double reach(const vndf_member *member)
{
    return member->profile->f1 * member->profile->scale;
}

/* ---- edges ---- */

static size_t add_edges(const vndf_member *member, double *edge)
{
    const vndf_profile *profile = member->profile;
    for (size_t i = 0; i <= profile->count; i++)
        edge[i] = profile->panel[i].r * profile->scale;
    return profile->count + 1;
}

/* All edges of the three, ascending; to be freed. */
static double *edges_of(const vndf_member *const three[3], size_t *count)
{
    size_t room = 3;
    for (int i = 0; i < 3; i++)
        room += three[i]->profile->count;
    double *edge = malloc(room * sizeof *edge);
    *count = 0;
    for (int i = 0; edge && i < 3; i++)
        *count += add_edges(three[i], edge + *count);
    if (edge)
        qsort(edge, *count, sizeof *edge, vndf_ascending);
    return edge;
}

/* ---- the sum ---- */

typedef struct comparison {
    const vndf_member *low, *high, *member;
    double weight_low, weight_high, per_mixed, per_member; /* over the integrals of P22 r^2 */
} comparison;

static void add_panel(const comparison *c, double from, double to, vndf_distances *sum)
{
    for (int i = 0; i < VNDF_GAUSS; i++) {
        double r = from + (to - from) * vndf_gauss_node[i], dr = (to - from) * vndf_gauss_weight[i];
        double mixed = c->weight_low * p22(c->low, r) + c->weight_high * p22(c->high, r), own = p22(c->member, r);
        sum->slopes += PI * fabs(mixed - own) * r * dr;
        sum->grazing += 0.5 * fabs(mixed * c->per_mixed - own * c->per_member) * r * r * dr;
    }
}

int vndf_distance_at(const vndf_member *low, const vndf_member *high, const vndf_member *member, double t,
                     vndf_distances *found)
{
    const vndf_member *const three[3] = {low, high, member};
    size_t count;
    double *edge = edges_of(three, &count);
    comparison c = {low, high, member, 1 - t, t, 0, 1 / reach(member)};
    c.per_mixed = 1 / (c.weight_low * reach(low) + c.weight_high * reach(high));
    *found = (vndf_distances){0, 0};
    for (size_t i = 0; edge && i + 1 < count; i++)
        if (edge[i + 1] > edge[i])
            add_panel(&c, edge[i], edge[i + 1], found);
    free(edge);
    return edge != NULL;
}
