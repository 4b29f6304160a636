/* What vndf_stratified_error says is right: GGX by its own map is as good as spherical caps, which draw the same normals
 * in other words; and a table of GGX loses little against it. */
#include "harness/test.h"
#include "measure/stratified_error.h"
#include "oracle/oracle.h"

int main(void)
{
    vndf_source *source = vndf_source_family("ggx", NULL);
    vndf_distribution *table = source ? vndf_build(source, NULL, NULL, NULL) : NULL;
    double closed = vndf_stratified_error(vndf_ggx(), 64), drawn = table ? vndf_stratified_error(table, 64) : NAN;
    fprintf(stderr, "RMSE over that of spherical caps: closed form %.3f, table %.3f\n", closed, drawn);
    TEST(closed > 0.8 && closed < 1.25);
    TEST(drawn > 0.5 && drawn < 2);
    vndf_free(table);
    vndf_source_free(source);
    return test_done();
}
