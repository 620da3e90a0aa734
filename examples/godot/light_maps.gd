# SPDX-License-Identifier: MIT
# Shows what `conelight bake SCENE -o DIR --lightmaps --direct` wrote, in Godot 3.2 and later 3.x.
#
# Copy DIR's scene.glb, lightmaps.json and lightmap_N.hdr into a project, and attach this script to a Spatial. All light
# is in the maps; maps without --direct go with lights of the scene. How: docs/guide/bake.md, "In Godot".
extends Spatial

export(String, DIR) var folder = "res://"

const CODE = """
shader_type spatial;
render_mode %s;
uniform sampler2D light_map : hint_black;
uniform vec2 light_offset;
uniform vec2 light_scale;
uniform vec4 base_color : hint_color;
uniform sampler2D base_texture : hint_albedo;
uniform vec4 shine : hint_color;
uniform float shine_energy;
void fragment() {
	vec3 albedo = base_color.rgb * texture(base_texture, UV).rgb;
	vec3 irradiance = texture(light_map, light_offset + light_scale * UV2).rgb;
	vec3 baked = albedo * irradiance / 3.14159265 + shine.rgb * shine_energy;
	%s
}
"""

# All light is baked, or the engine's own lights add to it.
const ALL = ["unshaded", "ALBEDO = baked;"]
const INDIRECT = ["blend_mix", "ALBEDO = albedo; EMISSION = baked; ROUGHNESS = 1.0;"]

var shader = Shader.new()


func _ready():
	var described = read_json(folder.plus_file("lightmaps.json"))
	shader.code = CODE % (ALL if described["light"] == "all" else INDIRECT)
	var maps = []
	for map in described["maps"]:
		maps.append(load(folder.plus_file(map["hdr"])))
	var scene = load(folder.plus_file(described["file"])).instance()
	add_child(scene)
	if described["light"] == "all":
		remove_lights(scene)
	var objects = {}
	collect(scene, objects)
	for place in described["instances"]:
		for object in objects.get(node_name(place["name"]), []):
			light(object, maps[place["map"]], place)


func read_json(path):
	var file = File.new()
	if file.open(path, File.READ) != OK:
		push_error(path + ": cannot be read")
		return {"light": "", "file": "", "maps": [], "instances": []}
	var parsed = JSON.parse(file.get_as_text())
	file.close()
	return parsed.result


# Nodes are called as the importer calls them.
func node_name(name):
	for letter in [".", ":", "@", "/", "\""]:
		name = name.replace(letter, "")
	return name


func collect(node, objects):
	if node is MeshInstance:
		if not objects.has(node.name):
			objects[node.name] = []
		objects[node.name].append(node)
	for child in node.get_children():
		collect(child, objects)


func remove_lights(node):
	for child in node.get_children():
		if child is Light:
			child.queue_free()
		else:
			remove_lights(child)


func light(object, map, place):
	for surface in object.mesh.get_surface_count():
		var from = object.mesh.surface_get_material(surface)
		var material = ShaderMaterial.new()
		material.shader = shader
		material.set_shader_param("light_map", map)
		material.set_shader_param("light_offset", Vector2(place["offset"][0], place["offset"][1]))
		material.set_shader_param("light_scale", Vector2(place["scale"][0], place["scale"][1]))
		material.set_shader_param("shine", Color(0, 0, 0))
		material.set_shader_param("base_color", from.albedo_color if from is SpatialMaterial else Color(1, 1, 1))
		if from is SpatialMaterial:
			if from.albedo_texture:
				material.set_shader_param("base_texture", from.albedo_texture)
			if from.emission_enabled:
				material.set_shader_param("shine", from.emission)
				material.set_shader_param("shine_energy", from.emission_energy)
		object.set_surface_material(surface, material)
