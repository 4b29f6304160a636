/* Weights and shares of the lobes of a mixture: D = sum of w_i D_i gives A = sum of w_i A_i, and lobe i is drawn with
 * the share w_i A_i/A. Shares are kept themselves, never as differences of running sums: that of a faint lobe has all
 * its digits. Loops end at lobe_end(count), which a page may make a constant; `lobe_numbers` has the array `lobe` of
 * one number each, or points to it: who gives one away does not read it again. */
#ifndef VNDF_KERNEL_SHARES_H
#define VNDF_KERNEL_SHARES_H

/* Weights over the largest and then over their sum. All are 0 unless all are >= 0 and finite, and one is above 0. */
KERNEL lobe_numbers lobe_weights(lobe_numbers given, int count)
{
    lobe_numbers w = given;
    real largest = set(0.0f), sum = set(0.0f);
    mask good = le(largest, sum);
    for (int i = 0; i < lobe_end(count); i++)
        if (i < count) {
            good = both(good, both(le(set(0.0f), w.lobe[i]), le(w.lobe[i], set(3.4028234e38f))));
            largest = max(largest, w.lobe[i]);
        }
    for (int j = 0; j < lobe_end(count); j++)
        if (j < count) {
            w.lobe[j] = select(good, w.lobe[j] / largest, set(0.0f));
            sum = sum + w.lobe[j];
        }
    for (int k = 0; k < lobe_end(count); k++)
        if (k < count)
            w.lobe[k] = select(lt(set(0.0f), sum), w.lobe[k] / sum, set(0.0f));
    return w;
}

/* The part of a lobe of the area of all, `sum`; `total` is the sum of the weights, which count alone where no lobe sees
 * an area that a float holds. */
KERNEL real lobe_part(real weight, real area)
{
    return select(lt(set(0.0f), weight), weight * area, set(0.0f));
}

KERNEL real lobe_fraction(real part, real weight, real sum, real total)
{
    mask is_seen = lt(set(1.17549435e-38f), sum);
    return select(is_seen, part, weight) / select(is_seen, sum, total);
}

KERNEL lobe_numbers lobe_shares(lobe_numbers given, lobe_numbers areas, int count)
{
    lobe_numbers weight = given, share = areas;
    real sum = set(0.0f), total = set(0.0f);
    for (int i = 0; i < lobe_end(count); i++)
        if (i < count) {
            share.lobe[i] = lobe_part(weight.lobe[i], share.lobe[i]);
            sum = sum + share.lobe[i];
            total = total + weight.lobe[i];
        }
    for (int j = 0; j < lobe_end(count); j++)
        if (j < count)
            share.lobe[j] = lobe_fraction(share.lobe[j], weight.lobe[j], sum, total);
    return share;
}

/* A sum of densities, the largest of which this is: above 0 where something is seen. */
KERNEL real lobe_density(real sum, real largest)
{
    return select(lt(set(0.0f), largest), min(max(sum, set(1.17549435e-38f)), set(3.4028234e38f)), set(0.0f));
}

#endif
