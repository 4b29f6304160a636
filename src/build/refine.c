#include "build/refine.h"

#include <stdlib.h>
#include <string.h>

typedef struct interval {
    double a, b, urgency;
    vndf_interval_miss miss;
} interval;

/* A share is one of some fifty. */
static interval make_interval(double a, double b, vndf_interval_error *error, void *user)
{
    interval made = {a, b, 0.0, error(a, b, user)};
    made.urgency = 50 * made.miss.share > made.miss.alone ? 50 * made.miss.share : made.miss.alone;
    return made;
}

static void sift_down(interval *heap, size_t count, size_t i)
{
    for (;;) {
        size_t largest = i, left = 2 * i + 1, right = left + 1;
        if (left < count && heap[left].urgency > heap[largest].urgency)
            largest = left;
        if (right < count && heap[right].urgency > heap[largest].urgency)
            largest = right;
        if (largest == i)
            return;
        interval swap = heap[i];
        heap[i] = heap[largest];
        heap[largest] = swap;
        i = largest;
    }
}

static void sift_up(interval *heap, size_t i)
{
    while (i > 0 && heap[(i - 1) / 2].urgency < heap[i].urgency) {
        interval swap = heap[i];
        heap[i] = heap[(i - 1) / 2];
        heap[(i - 1) / 2] = swap;
        i = (i - 1) / 2;
    }
}

static double total(const interval *heap, size_t count)
{
    double sum = 0.0, most = 0.0;
    for (size_t i = 0; i < count; i++) {
        sum += heap[i].miss.share;
        most = heap[i].miss.alone > most ? heap[i].miss.alone : most;
    }
    return sum + most;
}

static double arithmetic_middle(double a, double b)
{
    return a + (b - a) / 2;
}

static void split(vndf_refinement *r, interval *heap, size_t intervals, double at, vndf_interval_error *error, void *user)
{
    interval whole = heap[0];
    interval left = make_interval(whole.a, at, error, user), right = make_interval(at, whole.b, error, user);
    r->knot[r->start + r->count++] = at;
    heap[0] = left;
    sift_down(heap, intervals, 0);
    heap[intervals] = right;
    sift_up(heap, intervals);
}

int vndf_refine(vndf_refinement *r, const double *start, size_t start_count, size_t limit, double enough,
                vndf_interval_middle *middle, vndf_interval_error *error, void *user)
{
    size_t intervals = start_count - 1;
    interval *heap = malloc((intervals + limit + 1) * sizeof *heap);
    r->start = start_count;
    r->count = 0;
    r->knot = malloc((start_count + limit) * sizeof *r->knot);
    r->error = malloc((limit + 1) * sizeof *r->error);
    if (!heap || !r->knot || !r->error) {
        free(heap);
        return 0;
    }
    memcpy(r->knot, start, start_count * sizeof *start);
    for (size_t i = 0; i < intervals; i++) {
        heap[i] = make_interval(start[i], start[i + 1], error, user);
        sift_up(heap, i);
    }
    for (;;) {
        r->error[r->count] = total(heap, intervals + r->count);
        if (r->count == limit || r->error[r->count] <= enough || heap[0].urgency <= 0.0)
            break;
        split(r, heap, intervals + r->count, (middle ? middle : arithmetic_middle)(heap[0].a, heap[0].b), error, user);
    }
    free(heap);
    return 1;
}

size_t vndf_refinement_needed(const vndf_refinement *r, double error)
{
    size_t n = 0;
    while (n < r->count && r->error[n] > error)
        n++;
    return n;
}

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

void vndf_refinement_knots(const vndf_refinement *r, size_t added, double *knots)
{
    memcpy(knots, r->knot, (r->start + added) * sizeof *knots);
    qsort(knots, r->start + added, sizeof *knots, by_value);
}

void vndf_refinement_free(vndf_refinement *r)
{
    free(r->knot);
    free(r->error);
    memset(r, 0, sizeof *r);
}
