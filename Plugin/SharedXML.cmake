# Fragments of proxy XML that several proxies share: a file says @WAFT_...@ where one comes in. What Core states of an
# option is not among them: <Option name="..."/> stands for it (expand_options.py).

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

# Python has no attribute of what is never shown: what scripts ask for, and the tool bar tells, is hidden so.
set(WAFT_HIDDEN [=[

        <Hints>
          <PropertyWidgetDecorator type="GenericDecorator" mode="visibility" property="Complete" values="0 1" inverse="1"/>
        </Hints>]=])

# Of a stage that can work in slices. The window asks by WorkInSlices, so that neither a saved state nor a trace tells
# of it: whoever loads these expects the whole result.
string(CONFIGURE [=[
      <Option name="Slice" panel_visibility="never"/>
      <Property name="WorkInSlices" command="WorkInSlices" panel_visibility="never">
        <Documentation>From now on the stage works as a window wants it: an update returns soon, and the work goes on beside.</Documentation>
      </Property>
      <DoubleVectorProperty name="SliceInUse" command="GetSlice" information_only="1" panel_visibility="never">
        <SimpleDoubleInformationHelper/>
        <Documentation>Seconds of work in an update, whoever asked for them.</Documentation>
      </DoubleVectorProperty>
      <Property name="GoOn" command="GoOn" panel_visibility="never">
        <Documentation>The next update goes on with the work that has not ended, and shows the motion so far; nothing where none is.</Documentation>
      </Property>
      <Property name="Hold" command="Hold" panel_visibility="never">
        <Documentation>Work that goes on beside waits, from its next tick on, until an update after GoOn.</Documentation>
      </Property>
      <Property name="LetGo" command="LetGo" panel_visibility="never">
        <Documentation>Discards the work that has not ended and what there is of the motion; the next update begins anew.</Documentation>
      </Property>
      <IntVectorProperty name="Complete" command="GetComplete" information_only="1" panel_visibility="advanced">
        <SimpleIntInformationHelper/>@WAFT_HIDDEN@
        <Documentation>1: nothing is left to do, the last update gave the whole result or failed; 0: it gave the motion so far.</Documentation>
      </IntVectorProperty>
      <DoubleVectorProperty name="WorkDone" command="GetWorkDone" information_only="1" panel_visibility="advanced">
        <SimpleDoubleInformationHelper/>@WAFT_HIDDEN@
        <Documentation>Of the work that has not ended: 0 to 1.</Documentation>
      </DoubleVectorProperty>
      <IntVectorProperty name="WorkState" command="GetWorkState" information_only="1" panel_visibility="never">
        <SimpleIntInformationHelper/>
        <Documentation>0: there is no work; 1: it is held; 2: it goes on beside; 3: it has come to its end, which the next update after GoOn shows.</Documentation>
      </IntVectorProperty>
      <DoubleVectorProperty name="SecondsLeft" command="GetSecondsLeft" information_only="1" panel_visibility="advanced">
        <SimpleDoubleInformationHelper/>@WAFT_HIDDEN@
        <Documentation>Seconds that the work takes from here on, by those that it took; below 0 while that is not known.</Documentation>
      </DoubleVectorProperty>
      <StringVectorProperty name="Message" command="GetWorkText" information_only="1" panel_visibility="advanced">
        <SimpleStringInformationHelper/>@WAFT_HIDDEN@
        <Documentation>What the stage does; done in the end, or why it failed.</Documentation>
      </StringVectorProperty>]=] WAFT_SLICES @ONLY)
