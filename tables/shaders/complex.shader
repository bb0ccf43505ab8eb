// Complex numbers as (real, imaginary).
float2 irido_mul(float2 a, float2 b)
{
    return float2(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x);
}

float2 irido_div(float2 a, float2 b)
{
    return float2(a.x * b.x + a.y * b.y, a.y * b.x - a.x * b.y) / dot(b, b);
}

// The root with a real part >= 0; for an imaginary part >= 0 its own is >= 0 too.
float2 irido_sqrt(float2 a)
{
    float size = length(a);
    float re = sqrt(max(0.5 * (size + a.x), 0.0));
    float im = sqrt(max(0.5 * (size - a.x), 0.0));
    return float2(re, PICK(a.y < 0.0, -im, im));
}
