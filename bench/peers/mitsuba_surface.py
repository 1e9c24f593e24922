"""Wedge's surface as a Mitsuba plugin, `wedge_surface`: Lambert plus a Phong or Blinn-Phong lobe.

Written from docs/method.md ("Surfaces"), not from the kernels, so that it checks them:

    Phong        ks (m + 2) / (2 pi) cos^m alpha
    Blinn-Phong  ks (m + 2)(m + 4) / (8 pi (2^(-m/2) + m)) cos^m theta_h

Both sides reflect. The interpolated normal shades, turned to the side of the face that is seen; where it looks
away from the viewer the face's own does; directions below the face itself get nothing.

Parameters: kd, ks (colours or textures), exponent, model ("lambert", "phong", "blinn_phong").
Import after mitsuba.set_variant().
"""

import drjit as dr
import mitsuba as mi


def cosine_power(cosine, exponent):
    """Nothing beyond a right angle, not even for an exponent of 0."""
    return dr.select(cosine > 0, dr.power(dr.maximum(cosine, 0), exponent), 0)


class WedgeSurface(mi.BSDF):
    def __init__(self, props):
        mi.BSDF.__init__(self, props)
        self.kd = props.get_texture("kd", 0.5)
        self.ks = props.get_texture("ks", 0.0)
        self.m = float(props.get("exponent", 0.0))
        self.model = props.get("model", "lambert")
        sides = mi.BSDFFlags.FrontSide | mi.BSDFFlags.BackSide
        lobe = mi.BSDFFlags.DiffuseReflection | mi.BSDFFlags.GlossyReflection
        self.m_components = [lobe | sides | mi.BSDFFlags.SpatiallyVarying]
        self.m_flags = self.m_components[0]

    def seen(self, si):
        """Unit vectors of the world: to the viewer, the face's normal and the normal that shades, on its side."""
        view = si.to_world(si.wi)
        face = dr.select(dr.dot(si.n, view) >= 0, si.n, -si.n)
        normal = si.sh_frame.n
        normal = dr.select(dr.dot(normal, face) < 0, -normal, normal)
        normal = dr.select(dr.dot(normal, view) > 0, normal, face)
        return view, mi.Normal3f(face), mi.Normal3f(normal)

    def colours(self, si, active):
        kd = self.kd.eval(si, active)
        ks = self.ks.eval(si, active) if self.model != "lambert" else mi.Color3f(0)
        return kd, ks

    def lobe_chance(self, kd, ks):
        d, s = mi.luminance(kd), mi.luminance(ks)
        return dr.select(s > 0, s / (d + s), 0)

    def lobe(self, view, normal, light):
        """cos^m of the lobe's angle, its factor, and the density of the lobe's sampling."""
        m = self.m
        if self.model == "phong":
            mirror = 2 * dr.dot(normal, view) * normal - view
            power = cosine_power(dr.dot(mirror, light), m)
            return power, (m + 2) / (2 * dr.pi), (m + 1) / (2 * dr.pi) * power
        half = dr.normalize(view + light)
        power = cosine_power(dr.dot(normal, half), m)
        factor = (m + 2) * (m + 4) / (8 * dr.pi * (2 ** (-m / 2) + m))
        density = (m + 1) / (2 * dr.pi) * power / (4 * dr.maximum(dr.dot(view, half), 1e-7))
        return power, factor, density

    def eval_world(self, si, light, active):
        """Value times cosine, and density, for a direction of the world."""
        view, face, normal = self.seen(si)
        cosine = dr.dot(normal, light)
        active = active & (cosine > 0) & (dr.dot(face, light) > 0)
        kd, ks = self.colours(si, active)
        value = kd * dr.inv_pi
        density = cosine * dr.inv_pi
        if self.model != "lambert":
            power, factor, lobe_density = self.lobe(view, normal, light)
            value += ks * (factor * power)
            density = dr.lerp(density, lobe_density, self.lobe_chance(kd, ks))
        return dr.select(active, value * cosine, 0), dr.select(active, density, 0)

    def eval(self, ctx, si, wo, active=True):
        return self.eval_world(si, si.to_world(wo), active)[0]

    def pdf(self, ctx, si, wo, active=True):
        return self.eval_world(si, si.to_world(wo), active)[1]

    def eval_pdf(self, ctx, si, wo, active=True):
        return self.eval_world(si, si.to_world(wo), active)

    def sample(self, ctx, si, choice, point, active=True):
        view, _, normal = self.seen(si)
        light = mi.Frame3f(normal).to_world(mi.warp.square_to_cosine_hemisphere(point))
        if self.model != "lambert":
            glossy = choice < self.lobe_chance(*self.colours(si, active))
            light = dr.select(glossy, self.sample_lobe(view, normal, point), light)
        value, density = self.eval_world(si, light, active)
        active = active & (density > 0)
        sample = mi.BSDFSample3f()
        sample.wo = si.to_local(light)
        sample.pdf = dr.select(active, density, 0)
        sample.eta = 1.0
        sample.sampled_type = mi.UInt32(+self.m_flags)
        sample.sampled_component = mi.UInt32(0)
        return sample, dr.select(active, value / density, 0)

    def sample_lobe(self, view, normal, point):
        cosine = dr.power(1 - point.x, 1 / (self.m + 1))
        sine = dr.safe_sqrt(1 - cosine * cosine)
        sin_phi, cos_phi = dr.sincos(2 * dr.pi * point.y)
        around = mi.Vector3f(sine * cos_phi, sine * sin_phi, cosine)
        if self.model == "phong":
            return mi.Frame3f(2 * dr.dot(normal, view) * normal - view).to_world(around)
        half = mi.Frame3f(normal).to_world(around)
        return 2 * dr.dot(view, half) * half - view

    def traverse(self, callback):
        callback.put_object("kd", self.kd, mi.ParamFlags.Differentiable)
        callback.put_object("ks", self.ks, mi.ParamFlags.Differentiable)

    def to_string(self):
        return "WedgeSurface[%s, exponent=%g]" % (self.model, self.m)


mi.register_bsdf("wedge_surface", lambda props: WedgeSurface(props))
