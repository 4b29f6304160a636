// What a surface reflects once, by samples: visible normals are drawn with vndf_sample, and the lamp with vndf_visible;
// each kind of sample is weighted by the densities of both (Veach & Guibas 1995), for which vndf_pdf is needed.

const float ETA = 1.5; // of plastic and glass

// What a boundary reflects at the cosine c, where n is the index on this side over that beyond.
float fresnel(float c, float n) {
    float below = 1.0 - n * n * (1.0 - c * c);
    float t = sqrt(max(below, 0.0));
    vec2 r = vec2(n * c - t, c - n * t) / vec2(n * c + t, c + n * t);
    return below > 0.0 ? 0.5 * dot(r, r) : 1.0;
}

// The mirror's colour at the cosine c: Schlick's term; of plastic and glass the exact one, unless engines are compared.
vec3 mirror(float c) {
    float up = 1.0 - clamp(c, 0.0, 1.0);
    vec3 front = front_colour();
    return material >= 3 && !is_engine ? vec3(fresnel(c, 1.0 / ETA)) : front + (vec3(1.0) - front) * pow(up, 5.0);
}

// Of a plastic, below its mirror.
vec3 base_colour() {
    return material == 3 ? vec3(0.52, 0.03, 0.025) : vec3(0.012);
}

// The light of one sample through the mirror: of a drawn normal, or of the lamp.
vec3 mirrored(frame f, vec3 at, vndf_view view, bool from_lamp, vec2 u) {
    vec3 to = lamp_direction(at, u);
    vec3 wo = local(f, to);
    vec3 wm = normalize(view.wi + wo);
    if (!from_lamp) {
        wm = vndf_sample(view, u.x, u.y).wm;
        wo = 2.0 * dot(view.wi, wm) * wm - view.wi;
        to = world(f, wo);
    }
    if (wo.z <= 0.0) {
        return vec3(0.0);
    }
    float of_lamp = lamp_density(at, to);
    float facing = dot(view.wi, wm);
    vec3 comes = from_lamp ? vec3(0.0) : wide_light(to);
    if (of_lamp > 0.0) {
        float drawn = vndf_pdf(view, wm) / (4.0 * facing);
        float value = from_lamp ? vndf_visible(view, wm) / (4.0 * facing) : drawn;
        comes += shine * (value / (drawn + of_lamp));
    }
    return comes * mirror(facing) * light_kept(view, wo);
}

// The light of one sample through a ball of glass, which is polished where the light comes in.
vec3 through_glass(frame f, vndf_view view, vec2 u) {
    vec3 wm = vndf_sample(view, u.x, u.y).wm;
    vec3 wo = refract(-view.wi, wm, 1.0 / ETA);
    vec3 d = world(f, wo);
    vec3 normal = normalize(f.z - 2.0 * dot(f.z, d) * d); // where d meets the ball from within
    vec3 to = refract(d, -normal, ETA);
    float passes = (1.0 - fresnel(dot(view.wi, wm), 1.0 / ETA)) * (1.0 - fresnel(dot(d, normal), ETA));
    if (wo.z >= 0.0 || passes <= 0.0) {
        return vec3(0.0);
    }
    vec3 comes = wide_light(to) + (lamp_density(to, to) > 0.0 ? shine : vec3(0.0));
    return comes * passes * vndf_g1(surface_here(), vec3(wo.xy, -wo.z));
}

// One sample of the lamp on the base of a plastic.
vec3 lamp_on_base(frame f, vec3 wi, vec2 u) {
    vec3 wo = local(f, lamp_direction(f.z, u));
    vec3 passes = (vec3(1.0) - mirror(wi.z)) * (vec3(1.0) - mirror(wo.z)) * base_colour() / PI;
    return shine * passes * max(wo.z, 0.0) / lamp_density(f.z, lamp.xyz);
}

// One sample of the wide light on the base of a plastic.
vec3 of_base(frame f, vec3 wi, vec2 u) {
    float r = sqrt(u.x);
    vec3 wo = vec3(r * cos(2.0 * PI * u.y), r * sin(2.0 * PI * u.y), sqrt(1.0 - u.x));
    vec3 passes = (vec3(1.0) - mirror(wi.z)) * (vec3(1.0) - mirror(wo.z)) * base_colour();
    return passes * wide_light(world(f, wo));
}

vec3 shaded(vec3 at, vec3 normal, vec3 to_eye, vec2 u_normal, vec2 u_lamp, vec2 u_base) {
    vec3 x = normalize(cross(vec3(0.0, 1.0, 1e-4), normal)); // runs around the sphere
    frame f = frame(x, cross(normal, x), normal);
    vec3 wi = local(f, to_eye);
    wi.z = max(wi.z, 1e-3);
    vndf_view view = vndf_view_from(surface_here(), normalize(wi));
    vec3 gets = vec3(0.0);
    for (int kind = 0; kind < (shine == vec3(0.0) ? 1 : 2); kind += 1) {
        gets += mirrored(f, at, view, kind == 1, kind == 1 ? u_lamp : u_normal);
    }
    if (material == 5 && !is_engine) {
        gets += through_glass(f, view, u_base);
    } else if (material >= 3 && !is_engine) {
        gets += of_base(f, view.wi, u_base) + lamp_on_base(f, view.wi, u_lamp);
    }
    return gets;
}
