# Fragments of proxy XML that several proxies share: a file says @WAFT_...@ where one comes in.

set(WAFT_TIMESTEP_VALUES [=[
      <DoubleVectorProperty name="TimestepValues" information_only="1" repeatable="1">
        <TimeStepsInformationHelper/>
        <Documentation>The times of the frames, in seconds.</Documentation>
      </DoubleVectorProperty>]=])

set(WAFT_ACTIVE [=[
      <IntVectorProperty name="Active" command="SetActive" number_of_elements="1" default_values="1" panel_visibility="advanced">
        <BooleanDomain name="bool"/>
        <Documentation>Whether the stage runs. One that rests takes none of its inputs and gives empty outputs.</Documentation>
      </IntVectorProperty>]=])

# Of a stage that can work in slices. The window asks by WorkInSlices, so that neither a saved state nor a trace tells
# of it: whoever loads these expects the whole result.
set(WAFT_SLICE [=[
      <DoubleVectorProperty name="Slice" command="SetSlice" number_of_elements="1" default_values="0" panel_visibility="never">
        <DoubleRangeDomain name="range" min="0" max="1e+09"/>
        <Documentation>Seconds of work after which an update shows the motion so far, to go on from there when it is asked to; 0: all at once. The motion comes to the same bits.</Documentation>
      </DoubleVectorProperty>]=])
set(WAFT_SLICES [=[
@WAFT_SLICE@
      <Property name="WorkInSlices" command="WorkInSlices" panel_visibility="never">
        <Documentation>From now on the stage works in slices as short as a window wants them.</Documentation>
      </Property>
      <DoubleVectorProperty name="SliceInUse" command="GetSlice" information_only="1" panel_visibility="never">
        <SimpleDoubleInformationHelper/>
        <Documentation>Seconds of work in an update, whoever asked for them.</Documentation>
      </DoubleVectorProperty>
      <Property name="GoOn" command="GoOn" panel_visibility="never">
        <Documentation>The next update goes on with the work that is held; nothing where none is.</Documentation>
      </Property>
      <IntVectorProperty name="Complete" command="GetComplete" information_only="1" panel_visibility="advanced">
        <SimpleIntInformationHelper/>
        <Documentation>1: nothing is left to do, the last update gave the whole result or failed; 0: it gave the motion so far.</Documentation>
      </IntVectorProperty>
      <DoubleVectorProperty name="WorkDone" command="GetWorkDone" information_only="1" panel_visibility="advanced">
        <SimpleDoubleInformationHelper/>
        <Documentation>Of the work that is held: 0 to 1.</Documentation>
      </DoubleVectorProperty>
      <StringVectorProperty name="Message" command="GetProgressText" information_only="1" panel_visibility="advanced">
        <SimpleStringInformationHelper/>
        <Documentation>What the stage does; done in the end, or why it failed.</Documentation>
      </StringVectorProperty>]=])
string(CONFIGURE "${WAFT_SLICES}" WAFT_SLICES @ONLY)

set(WAFT_SEED [=[
      <IntVectorProperty name="Seed" command="SetSeed" number_of_elements="1" default_values="1">
        <IntRangeDomain name="range" min="0"/>
        <Documentation>Seed of everything random in this stage. The same seed gives the same result, bit by bit, on any number of threads.</Documentation>
      </IntVectorProperty>]=])

# The scene's frame, for sources that make data without a scene file. The number of frames shows in the
# panel by default or among the advanced.
function(waft_scene_properties result visibility leastFrames)
  string(CONFIGURE [=[
      <DoubleVectorProperty name="Bounds" command="SetBounds" number_of_elements="6"
        default_values="-2 2 -2 2 0 4" panel_visibility="advanced">
        <DoubleRangeDomain name="range"/>
        <Documentation>The volume (xmin, xmax, ymin, ymax, zmin, zmax) in metres; z is up.</Documentation>
      </DoubleVectorProperty>
      <IntVectorProperty name="NumberOfFrames" label="Number Of Frames" command="SetNumberOfFrames"
        number_of_elements="1" default_values="300" panel_visibility="@visibility@">
        <IntRangeDomain name="range" min="@leastFrames@"/>
        <Documentation>Frames of the animation; frame k is at time k / FramesPerSecond.</Documentation>
      </IntVectorProperty>
      <DoubleVectorProperty name="FramesPerSecond" label="Frames Per Second" command="SetFramesPerSecond"
        number_of_elements="1" default_values="30" panel_visibility="advanced">
        <DoubleRangeDomain name="range" min="0.001"/>
        <Documentation>Frames per second.</Documentation>
      </DoubleVectorProperty>]=] properties @ONLY)
  set(${result} "${properties}" PARENT_SCOPE)
endfunction()
waft_scene_properties(WAFT_SCENE_PROPERTIES advanced 1)
waft_scene_properties(WAFT_DATABASE_SCENE default 2)

# Appends to a text the property of a number of random things, or of a range that they are drawn from.
function(waft_random_number text name default visibility documentation)
  string(REGEX REPLACE "([a-z])([A-Z])" "\\1 \\2" label "${name}")
  string(CONFIGURE [=[

      <IntVectorProperty name="@name@" label="@label@" command="Set@name@"
        number_of_elements="1" default_values="@default@" panel_visibility="@visibility@">
        <IntRangeDomain name="range" min="0" max="1000"/>
        <Documentation>@documentation@</Documentation>
      </IntVectorProperty>]=] property @ONLY)
  set(${text} "${${text}}${property}" PARENT_SCOPE)
endfunction()
function(waft_random_range text name default documentation)
  string(REGEX REPLACE "([a-z])([A-Z])" "\\1 \\2" label "${name}")
  string(CONFIGURE [=[

      <DoubleVectorProperty name="@name@" label="@label@" command="Set@name@"
        number_of_elements="2" default_values="@default@" panel_visibility="advanced">
        <DoubleRangeDomain name="range" min="0 0"/>
        <Documentation>@documentation@</Documentation>
      </DoubleVectorProperty>]=] property @ONLY)
  set(${text} "${${text}}${property}" PARENT_SCOPE)
endfunction()

# What drives the air of a source at random: <prefix>_NUMBERS, <prefix>_RANGES. The
# numbers show in the panel by default or among the advanced; the accelerations are the source's own.
function(waft_random_air prefix visibility vortexAcceleration windAcceleration)
  string(CONFIGURE [=[
      <DoubleVectorProperty name="WarmUpSeconds" label="Warm Up Seconds" command="SetWarmUpSeconds"
        number_of_elements="1" default_values="3" panel_visibility="advanced">
        <DoubleRangeDomain name="range" min="0"/>
        <Documentation>The air starts at rest and is driven for this long before frame 0, in seconds.</Documentation>
      </DoubleVectorProperty>]=] numbers @ONLY)
  waft_random_number(numbers NumberOfVortices 10 ${visibility}
    "Random vortices of a run.")
  waft_random_number(numbers NumberOfWinds 6 ${visibility}
    "Random winds of a run, parallel, decaying in space and time.")
  waft_random_number(numbers NumberOfObstacles 2 ${visibility}
    "Random obstacles of a run: boxes, cylinders and spheres.")
  waft_random_range(ranges VortexDiameter "0.22 0.44"
    "Range of the diameters of the random vortices, in widths of the volume: twice the radius where the acceleration at mid-segment falls to half its maximum.")
  waft_random_range(ranges VortexLength "0.3 0.8"
    "Range of the lengths of the random vortices, in widths of the volume.")
  waft_random_range(ranges VortexAcceleration "${vortexAcceleration}"
    "Range of the largest acceleration at mid-segment of the random vortices, in metres per second squared.")
  waft_random_range(ranges VortexDuration "2 4"
    "Range of the durations of the random vortices, in seconds: the standard deviation of the Gaussian in time.")
  waft_random_range(ranges WindRadius "0.2 0.5"
    "Range of the radii of the random winds, in widths of the volume.")
  waft_random_range(ranges WindAcceleration "${windAcceleration}"
    "Range of the accelerations of the random winds, in metres per second squared.")
  waft_random_range(ranges WindDuration "0.7 2"
    "Range of the durations of the random winds, in seconds.")
  waft_random_range(ranges ObstacleSize "0.08 0.25"
    "Range of the extents of the random obstacles, in widths of the volume.")
  string(REGEX REPLACE "^\n" "" ranges "${ranges}")
  set(${prefix}_NUMBERS "${numbers}" PARENT_SCOPE)
  set(${prefix}_RANGES "${ranges}" PARENT_SCOPE)
endfunction()
waft_random_air(WAFT_SMOKE default "0.23 0.92" "0.18 0.72")
waft_random_air(WAFT_DATABASE advanced "0.27 1.05" "0.16 0.65")

# A port that takes one connection: @WAFT_INPUT_POLYDATA@ inside an InputProperty. Of data in blocks the
# domain asks for the blocks' type, as the stages do (Bridge/Pipeline/StageInputs.h); a list of shapes is
# blocks itself, of either kind.
function(waft_input result domain)
  set(types)
  foreach(type IN LISTS ARGN)
    string(APPEND types "\n          <DataType value=\"${type}\"/>")
  endforeach()
  string(CONFIGURE [=[
        <ProxyGroupDomain name="groups">
          <Group name="sources"/>
          <Group name="filters"/>
        </ProxyGroupDomain>
        <DataTypeDomain @domain@>@types@
        </DataTypeDomain>]=] xml @ONLY)
  set(${result} "${xml}" PARENT_SCOPE)
endfunction()
waft_input(WAFT_INPUT_POLYDATA [[name="input_type"]] vtkPolyData)
waft_input(WAFT_INPUT_IMAGE [[name="input_type"]] vtkImageData)
waft_input(WAFT_INPUT_MULTIBLOCK [[name="input_type" composite_data_supported="1"]]
  vtkMultiBlockDataSet vtkPartitionedDataSet vtkPartitionedDataSetCollection)

# What the sources of one thin body share: <prefix>_BODY, with the defaults of each.
function(waft_thin_body prefix length curl camber twist areaDensity thickness settlingSpeed)
  string(CONFIGURE [=[
      <DoubleVectorProperty name="Length" command="SetLength" number_of_elements="1" default_values="@length@">
        <DoubleRangeDomain name="range" min="1e-9"/>
        <Documentation>Largest extent in metres.</Documentation>
      </DoubleVectorProperty>
      <DoubleVectorProperty name="Curl" command="SetCurl" number_of_elements="1" default_values="@curl@">
        <DoubleRangeDomain name="range" min="0" max="2"/>
        <Documentation>Rise of the edges over half the local width.</Documentation>
      </DoubleVectorProperty>
      <DoubleVectorProperty name="Camber" command="SetCamber" number_of_elements="1" default_values="@camber@">
        <DoubleRangeDomain name="range" min="0" max="0.5"/>
        <Documentation>Rise of both ends over the length.</Documentation>
      </DoubleVectorProperty>
      <DoubleVectorProperty name="Twist" command="SetTwist" number_of_elements="1" default_values="@twist@">
        <DoubleRangeDomain name="range" min="-1" max="1"/>
        <Documentation>Turn of the tip against the base, in radians.</Documentation>
      </DoubleVectorProperty>
      <DoubleVectorProperty name="AreaDensity" label="Area Density" command="SetAreaDensity"
        number_of_elements="1" default_values="@areaDensity@" panel_visibility="advanced">
        <DoubleRangeDomain name="range" min="1e-6"/>
        <Documentation>Mass of a square metre, in kilograms.</Documentation>
      </DoubleVectorProperty>
      <DoubleVectorProperty name="Thickness" command="SetThickness"
        number_of_elements="1" default_values="@thickness@" panel_visibility="advanced">
        <DoubleRangeDomain name="range" min="1e-9"/>
        <Documentation>Thickness in metres.</Documentation>
      </DoubleVectorProperty>
      <DoubleVectorProperty name="DragCoefficient" label="Drag Coefficient" command="SetDragCoefficient"
        number_of_elements="1" default_values="1.2" panel_visibility="advanced">
        <DoubleRangeDomain name="range" min="1e-9"/>
        <Documentation>Drag coefficient, broadside.</Documentation>
      </DoubleVectorProperty>
      <DoubleVectorProperty name="SettlingSpeed" label="Settling Speed" command="SetSettlingSpeed"
        number_of_elements="1" default_values="@settlingSpeed@" panel_visibility="advanced">
        <DoubleRangeDomain name="range" min="0"/>
        <Documentation>Terminal fall speed in still air, in metres per second.</Documentation>
      </DoubleVectorProperty>@WAFT_SCENE_PROPERTIES@]=] body @ONLY)
  set(${prefix}_BODY "${body}" PARENT_SCOPE)
endfunction()
waft_thin_body(WAFT_LEAF 0.1 0.3 0.05 0 0.1 0.0004 0.8)
waft_thin_body(WAFT_FEATHER 0.2 0.5 0.1 0.15 0.04 0.0005 0.4)

# The painted skin of leaves and feathers: <prefix>_SKIN.
function(waft_skin prefix rows base edge vein blotches)
  string(CONFIGURE [=[
      <DoubleVectorProperty name="Width" command="SetWidth" number_of_elements="1" default_values="1">
        <DoubleRangeDomain name="range" min="0.3" max="3"/>
        <Documentation>Width of the outline; 1 is what the kind has by nature.</Documentation>
      </DoubleVectorProperty>
      <DoubleVectorProperty name="Bend" command="SetBend" number_of_elements="1" default_values="1">
        <DoubleRangeDomain name="range" min="-5" max="5"/>
        <Documentation>Bend of the middle line; 1 is what the kind has by nature.</Documentation>
      </DoubleVectorProperty>
      <IntVectorProperty name="Rows" command="SetRows" number_of_elements="1" default_values="@rows@" panel_visibility="advanced">
        <IntRangeDomain name="range" min="4" max="200"/>
        <Documentation>Rows of the mesh along its length.</Documentation>
      </IntVectorProperty>
      <IntVectorProperty name="Columns" command="SetColumns" number_of_elements="1" default_values="8" panel_visibility="advanced">
        <IntRangeDomain name="range" min="2" max="64"/>
        <Documentation>Columns of the mesh across; an odd number counts as the next even one.</Documentation>
      </IntVectorProperty>
      <StringVectorProperty name="TextureFile" label="Texture File" command="SetTextureFile" number_of_elements="1" default_values="">
        <FileListDomain name="files"/>
        <Hints>
          <FileChooser extensions="png" file_description="PNG pictures"/>
          <AcceptAnyFile/>
        </Hints>
        <Documentation>The PNG file that the painted skin is written to; empty: no skin, the plain Base Color.</Documentation>
      </StringVectorProperty>
      <IntVectorProperty name="TextureSize" label="Texture Size" command="SetTextureSize" number_of_elements="1" default_values="512" panel_visibility="advanced">
        <IntRangeDomain name="range" min="16" max="4096"/>
        <Documentation>Pixels of the skin along the length.</Documentation>
      </IntVectorProperty>
      <DoubleVectorProperty name="BaseColor" label="Base Color" command="SetBaseColor" number_of_elements="3" default_values="@base@" panel_widget="color_selector">
        <DoubleRangeDomain name="range" min="0 0 0" max="1 1 1"/>
        <Documentation>Colour near the middle: red, green, blue.</Documentation>
      </DoubleVectorProperty>
      <DoubleVectorProperty name="EdgeColor" label="Edge Color" command="SetEdgeColor" number_of_elements="3" default_values="@edge@" panel_widget="color_selector">
        <DoubleRangeDomain name="range" min="0 0 0" max="1 1 1"/>
        <Documentation>Colour of edges, blotches and bands: red, green, blue.</Documentation>
      </DoubleVectorProperty>
      <DoubleVectorProperty name="VeinColor" label="Vein Color" command="SetVeinColor" number_of_elements="3" default_values="@vein@" panel_widget="color_selector">
        <DoubleRangeDomain name="range" min="0 0 0" max="1 1 1"/>
        <Documentation>Colour of veins, stem or shaft: red, green, blue.</Documentation>
      </DoubleVectorProperty>
      <DoubleVectorProperty name="Blotches" command="SetBlotches" number_of_elements="1" default_values="@blotches@">
        <DoubleRangeDomain name="range" min="0" max="1"/>
        <Documentation>How much of the edge's colour comes in blotches or bands.</Documentation>
      </DoubleVectorProperty>
@WAFT_SEED@]=] skin @ONLY)
  set(${prefix}_SKIN "${skin}" PARENT_SCOPE)
endfunction()
waft_skin(WAFT_LEAF 28 "0.36 0.52 0.14" "0.66 0.62 0.16" "0.74 0.78 0.44" 0.35)
waft_skin(WAFT_FEATHER 36 "0.93 0.9 0.84" "0.44 0.31 0.22" "0.9 0.84 0.72" 0.9)
