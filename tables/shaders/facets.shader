// Facets of GGX roughness. Directions are unit vectors away from the surface, z along its normal.

// The BRDF, 1/sr, over the reflectance at theta_d: D G1 G1 / (4 cos theta_i cos theta_o). Times the
// colour of the stack (snippet color) at irido_cos_theta_d it is one reflection at a rough stack.
float irido_facets(float alpha, float3 light, float3 view)
{
    if (light.z <= 0.0 || view.z <= 0.0) { return 0.0; }
    float3 h = normalize(light + view);
    float a2 = alpha * alpha;
    float spread = a2 * h.z * h.z + h.x * h.x + h.y * h.y;
    float l2 = light.z * light.z, v2 = view.z * view.z;
    float seen = (1.0 + sqrt(1.0 + a2 * (1.0 - l2) / l2)) * (1.0 + sqrt(1.0 + a2 * (1.0 - v2) / v2));
    return a2 / (3.14159265359 * spread * spread * seen * light.z * view.z);
}

// Cosine of the angle between light and half vector.
float irido_cos_theta_d(float3 light, float3 view)
{
    return min(0.5 * length(light + view), 1.0);
}
