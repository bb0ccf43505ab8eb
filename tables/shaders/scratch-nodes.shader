// Scratches without a table of colours: the spectrum at the nodes of irido lut scratch-nodes, 33 or
// 49 of them. Lengths are um. u = W q for a scratch of width W, q = dot(light + view, b), b the
// unit vector across it in the surface.

// F(x) = Si(x) - (1 - cos x)/x, to 1e-6. Source: M. Abramowitz, I. A. Stegun, 5.2.38, 5.2.39.
float irido_slit_integral(float x)
{
    float a = abs(x), a2 = a * a, f, g, value;
    if (a < 1.0)
    {
        value = a * (0.5 - a2 * (1.0 / 72.0 - a2 * (1.0 / 3600.0 - a2 * (1.0 / 282240.0))));
    }
    else
    {
        f = (((a2 + 38.027264) * a2 + 265.187033) * a2 + 335.677320) * a2 + 38.102495;
        f /= (((a2 + 40.021433) * a2 + 322.624911) * a2 + 570.236280) * a2 + 157.105423;
        g = (((a2 + 42.242855) * a2 + 302.757865) * a2 + 352.018498) * a2 + 21.821899;
        g /= (((a2 + 48.196927) * a2 + 482.485984) * a2 + 1114.978885) * a2 + 449.690326;
        value = 1.57079632679 - (1.0 + (f - 1.0) * cos(a) + g / a * sin(a)) / a;
    }
    return x < 0.0 ? -value : value;
}

// Radiance over a light's that covers q0 to q1, times 1/rho; v is the optical path of the depth D,
// 2 D or D (cos theta_i + cos theta_o). X, Y, Z of the table's illuminant and observer.
float3 irido_scratch_nodes(TEXTURE2D(nodes), float count, float u0, float u1, float v)
{
    float3 sum = float3(0.0, 0.0, 0.0);
    for (float i = 0.5; i < count; i += 1.0)
    {
        float4 node = SAMPLE2D(nodes, float2(i / count, 0.5), 0.0);  // nu, X, Y, Z
        float groove = sin(3.14159265359 * fract(v * node.x));
        float x0 = 6.28318530718 * u0 * node.x, x1 = 6.28318530718 * u1 * node.x;
        float lobe = irido_slit_integral(x1) - irido_slit_integral(x0);
        sum += node.yzw * (4.0 * groove * groove * lobe * 0.318309886184);
    }
    return sum;
}

// T'(u): many scratches of one width at all angles reflect rho W / (pi |xi|) of it per steradian,
// with u = W |xi|.
float3 irido_scratch_nodes_slope(TEXTURE2D(nodes), float count, float u, float v)
{
    float3 sum = float3(0.0, 0.0, 0.0);
    for (float i = 0.5; i < count; i += 1.0)
    {
        float4 node = SAMPLE2D(nodes, float2(i / count, 0.5), 0.0);
        float groove = sin(3.14159265359 * fract(v * node.x));
        float x = 3.14159265359 * u * node.x, s = abs(x) < 0.01 ? 1.0 - x * x / 6.0 : sin(x) / x;
        sum += node.yzw * (4.0 * groove * groove * node.x * s * s);
    }
    return sum;
}

// A point light's BRDF, 1/sr, over exp(-s_b^2/sigma^2) or the footprint's G: xi = light + view along the
// scratch and across it, v as above, sigma the coherence radius.
float3 irido_scratch_nodes_point(TEXTURE2D(nodes), float count, float width_um, float2 xi, float v,
                                 float sigma_um)
{
    float3 sum = float3(0.0, 0.0, 0.0);
    for (float i = 0.5; i < count; i += 1.0)
    {
        float4 node = SAMPLE2D(nodes, float2(i / count, 0.5), 0.0);
        float groove = sin(3.14159265359 * fract(v * node.x));
        float y = 6.28318530718 * sigma_um * xi.x * node.x;
        // sin(x)/x, whose square has no sign to lose
        float x = max(abs(3.14159265359 * width_um * xi.y * node.x), 1.0e-3);
        float slit = width_um * node.x * sin(x) / x;
        sum += node.yzw * (8.0 * groove * groove * slit * slit * exp(-y * y));
    }
    return sum;
}
