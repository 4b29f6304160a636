// One bounce of a path tracer at a rough metal, in GLSL, after
//     vndf export tables/student-t-2.5-small.vndf --language glsl -o normals.glsl
// and #include or a copy of normals.glsl before this. wi is towards where the path comes from, unit, in the frame of the
// surface (z is its normal); random is two numbers of [0, 1); f0 is the metal's colour.
struct bounce {
    vec3 wo;     // the new direction; black paths have weight 0
    vec3 weight; // f cos/pdf
    float pdf;   // per steradian, for multiple importance sampling
};

bounce bounce_at_metal(vec3 wi, float roughness, vec3 f0, vec2 random) {
    float alpha = max(roughness * roughness, 0.02);
    vndf_surface surface = vndf_surface_of(VNDF_STUDENT_T_2_5_SMALL, alpha, alpha);
    vndf_view view = vndf_view_of(surface, wi);
    vndf_sampled drawn = vndf_sample(view, random.x, random.y);
    float facing = dot(wi, drawn.wm);
    vec3 wo = 2.0 * facing * drawn.wm - wi;
    // f = D F G2/(4 wi.z wo.z), and the density of wo is pdf/(4 facing). Dv = G1 D facing/wi.z leaves F G2/G1 times
    // drawn.weight, the true visible density over the drawn one: 1 within what the table states.
    vec3 fresnel = f0 + (1.0 - f0) * pow(1.0 - facing, 5.0);
    float g = vndf_g2(surface, wi, wo) / max(vndf_g1(surface, wi), 1e-30);
    return bounce(wo, wo.z > 0.0 ? fresnel * (g * drawn.weight) : vec3(0.0), drawn.pdf / (4.0 * facing));
}

// Value and density of a given wo, for light that was sampled: f cos in xyz, density in w.
vec4 metal_towards(vec3 wi, vec3 wo, float roughness, vec3 f0) {
    float alpha = max(roughness * roughness, 0.02);
    vndf_surface surface = vndf_surface_of(VNDF_STUDENT_T_2_5_SMALL, alpha, alpha);
    if (wi.z <= 0.0 || wo.z <= 0.0) {
        return vec4(0.0);
    }
    vec3 wm = normalize(wi + wo);
    float facing = dot(wi, wm);
    vec3 fresnel = f0 + (1.0 - f0) * pow(1.0 - facing, 5.0);
    float f_cos = vndf_ndf(surface, wm) * vndf_g2(surface, wi, wo) / (4.0 * wi.z);
    return vec4(fresnel * f_cos, vndf_pdf(vndf_view_of(surface, wi), wm) / (4.0 * facing));
}
